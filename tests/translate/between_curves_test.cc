#include "lyrefit/translate/procedure_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "synthetic_string.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

FurtherCurve Further(const SyntheticModule& module, double g, double t_C) {
  return {module.Readings(g, t_C), g, t_C, module.Diode(g, t_C)};
}

// Procedure 3 between 1000 and 600 W/m2 at one temperature, half way.
TEST(BetweenCurves, MeetsTheTruthBetweenTwoLights) {
  const SyntheticModule module;
  PreparedCurve curve = module.Curve(1000, 45, {800, 45});
  curve.further = {Further(module, 600, 45)};
  const TranslationInputs in = module.Inputs(1000, 45);
  EXPECT_NEAR(PlaceBetween(curve, in), 0.5, 1e-12);
  const auto key = TranslatedKeyPoints(Procedure::kIec3, curve, in);
  ASSERT_TRUE(key) << key.error().message;
  const KeyPoints truth = module.Truth(800, 45);
  EXPECT_NEAR(key->max_power_W, truth.max_power_W, 3e-3 * truth.max_power_W);
  EXPECT_NEAR(key->open_circuit_voltage_V, truth.open_circuit_voltage_V, 0.1);
  EXPECT_NEAR(key->short_circuit_current_A, truth.short_circuit_current_A, 1e-3);
}

TEST(BetweenCurves, ReachesAnyPlaceInATriangle) {
  const SyntheticModule module;
  PreparedCurve curve = module.Curve(1000, 50, {850, 35});
  curve.further = {Further(module, 700, 45), Further(module, 900, 20)};
  const auto key = TranslatedKeyPoints(Procedure::kIec3, curve, module.Inputs(1000, 50));
  ASSERT_TRUE(key) << key.error().message;
  const KeyPoints truth = module.Truth(850, 35);
  EXPECT_NEAR(key->max_power_W, truth.max_power_W, 3e-3 * truth.max_power_W);
  EXPECT_NEAR(key->open_circuit_voltage_V, truth.open_circuit_voltage_V, 0.05);
}

TEST(BetweenCurves, RefusesWhatLiesOffTheLineOrTooFar) {
  const SyntheticModule module;
  const TranslationInputs in = module.Inputs(1000, 45);
  const auto refusal = [&](const TranslationTarget& target, const FurtherCurve& further) {
    PreparedCurve curve = module.Curve(1000, 45, target);
    curve.further = {further};
    const auto key = BetweenCurves(curve, in);
    return key ? std::string() : key.error().message;
  };
  const FurtherCurve dim = Further(module, 600, 45);
  EXPECT_THAT(refusal({800, 25}, dim), HasSubstr("20.0 K off the line"));
  EXPECT_THAT(refusal({100, 45}, dim), HasSubstr("further beyond"));
  EXPECT_THAT(refusal({800, 45}, Further(module, 1000, 45)), HasSubstr("same light"));
}

}  // namespace
}  // namespace lyrefit
