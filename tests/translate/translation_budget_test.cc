#include "lyrefit/translate/translation_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_string.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr Procedure kEveryProcedure[] = {
    Procedure::kIec1,   Procedure::kIec2,   Procedure::kIec3,    Procedure::kIec4,
    Procedure::kDeSoto, Procedure::kPvsyst, Procedure::kExtended};

// All inputs are exact, so only the uncertainty of the procedure remains.
UncertaintyOptions Nothing() {
  UncertaintyOptions options;
  options.draws = 0;
  options.irradiance_percent = options.temperature_K = options.cell_offset_K = 0.0;
  options.voltage_percent = options.current_percent = 0.0;
  options.alpha_percent = options.beta_percent = 0.0;
  options.kappa_percent = options.series_resistance_percent = options.light_of_voc_percent = 0;
  options.bandgap_percent = options.bandgap_slope_percent = 0;
  options.ideality_slope_percent_per_K = 0;
  return options;
}

double ExpandedPart(const TranslationTarget& target, const UncertaintyOptions& options) {
  const SyntheticModule module;
  const PreparedCurve curve = module.Curve(800, 45, target);
  const SettledInputs settled =
      SettleInputs(module.Coefficients(), "c-Si", curve, module.Bare(800, 45));
  const auto budget = TranslationBudget(Procedure::kDeSoto, curve, settled, {}, options);
  if (!budget) return -1;
  const UncertainOutput& power = budget->outputs[kMaxPowerOutput];
  return power.expanded_uncertainty /
         module.Truth(target.irradiance_W_m2, target.temperature_C).max_power_W;
}

TEST(TranslationErrorOf, HasSixSizesForEveryProcedureAndTheirSource) {
  for (const Procedure procedure : kEveryProcedure) {
    const TranslationError error = TranslationErrorOf(procedure);
    ASSERT_EQ(error.light.size(), 6U) << ToText(procedure);
    ASSERT_EQ(error.temperature.size(), 6U);
    EXPECT_FALSE(error.source.empty());
    for (const double size : error.light) EXPECT_GT(size, 0);
  }
}

TEST(TranslationBudget, OfNoStepIsNone) { EXPECT_LT(ExpandedPart({800, 45}, Nothing()), 1e-9); }

// The variance is proportional to the step: four times the log ratio of light doubles the
// uncertainty.
TEST(TranslationBudget, GrowsWithTheRootOfTheStep) {
  const double once = ExpandedPart({800 * std::exp(-0.1), 45}, Nothing());
  const double four = ExpandedPart({800 * std::exp(-0.4), 45}, Nothing());
  EXPECT_NEAR(once, TranslationErrorOf(Procedure::kDeSoto).light[kMaxPowerOutput] * std::sqrt(0.1),
              1e-4);
  EXPECT_NEAR(four / once, 2, 0.02);
}

TEST(TranslationBudget, TakesAStatedSize) {
  UncertaintyOptions options = Nothing();
  options.translation_percent = 3;
  EXPECT_NEAR(ExpandedPart({1000, 25}, options), 0.03, 2e-4);
}

TEST(TranslationBudget, CountsTheSpreadOfAlternativesOnce) {
  const SyntheticModule module;
  const PreparedCurve curve = module.Curve(500, 45, {});
  const SettledInputs settled =
      SettleInputs(module.Coefficients(), "c-Si", curve, module.Bare(500, 45));
  TranslationDoubts doubts;
  doubts.alternatives = {Procedure::kIec1, Procedure::kIec3, Procedure::kPvsyst};
  const auto budget = TranslationBudget(Procedure::kDeSoto, curve, settled, doubts, Nothing());
  ASSERT_TRUE(budget) << budget.error().message;
  int choices = 0;
  for (const auto& line : budget->lines) {
    EXPECT_NE(line.name, "translation");
    choices += line.name == "procedure";
  }
  EXPECT_EQ(choices, 1);
}

}  // namespace
}  // namespace lyrefit
