// Effects of tracers and of varying light on a sweep, each applied alone to the curve of a module.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../repeats.h"
#include "diagnose/synthetic_diagnosis.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

IvCurve ModuleCurve(bool and_back = false) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.points = 120;
  recipe.and_back = and_back;
  return SyntheticCurve(recipe);
}

std::vector<Cause> CausesOf(const IvCurve& curve) { return DiagnoseOrFail(curve).verdict.causes; }

void ExpectHeld(const CauseParameter& parameter, const char* symbol, double truth) {
  EXPECT_EQ(parameter.symbol, symbol);
  EXPECT_LE(parameter.low_95, truth);
  EXPECT_GE(parameter.high_95, truth);
}

void ChangeRange(double below_A, double gain, IvCurve* curve) {
  for (double& i : curve->current_A) i *= i < below_A ? 1 + gain : 1;
}

TEST(TracerCauses, AChangeOfRangeInBothSweepsIsNamed) {
  SKIP_IF_SANITIZED();
  for (const double gain : {0.05, -0.06}) {
    IvCurve curve = ModuleCurve(true);
    ChangeRange(6, gain, &curve);
    const std::vector<Cause> causes = CausesOf(curve);
    ASSERT_THAT(causes, SizeIs(1));
    EXPECT_EQ(causes[0].id, "range_switch");
    EXPECT_THAT(causes[0].equivalents, IsEmpty());
    ASSERT_THAT(causes[0].strength, SizeIs(2));
    ExpectHeld(causes[0].strength[0], "g", gain);
    EXPECT_NEAR(causes[0].strength[1].value, 6, 0.4);
  }
}

TEST(TracerCauses, OneSweepDoesNotTellAChangeOfRangeFromACloud) {
  SKIP_IF_SANITIZED();
  IvCurve curve = ModuleCurve();
  ChangeRange(7.3, 0.05, &curve);
  const std::vector<Cause> causes = CausesOf(curve);
  ASSERT_FALSE(causes.empty());
  if (causes[0].id != "range_switch") {
    EXPECT_EQ(causes[0].id, "irr_step");
    EXPECT_THAT(causes[0].equivalents, Contains("range_switch"));
  }
}

TEST(TracerCauses, CoarseBinsOfTheVoltageAreNamedAndNothingBecauseOfThem) {
  SKIP_IF_SANITIZED();
  IvCurve curve = ModuleCurve();
  constexpr double kBin_V = 0.23;
  for (double& v : curve.voltage_V) v = kBin_V * std::round(v / kBin_V);
  const std::vector<Cause> causes = CausesOf(curve);
  ASSERT_THAT(causes, SizeIs(1));
  EXPECT_EQ(causes[0].id, "voltage_bins");
  ASSERT_THAT(causes[0].strength, SizeIs(1));
  EXPECT_NEAR(causes[0].strength[0].value, kBin_V, 1e-6);
}

TEST(TracerCauses, FineDigitsOfTheVoltageAreNone) {
  IvCurve curve = ModuleCurve();
  for (double& v : curve.voltage_V) v = 0.01 * std::round(v / 0.01);
  EXPECT_THAT(CausesOf(curve), IsEmpty());
}

TEST(TracerCauses, AVoltageAtTheEndOfItsRangeIsALimit) {
  IvCurve curve = ModuleCurve();
  const double end = curve.voltage_V[curve.size() - 12];
  for (double& v : curve.voltage_V) v = std::min(v, end);
  const std::vector<Cause> causes = CausesOf(curve);
  ASSERT_THAT(causes, SizeIs(1));
  EXPECT_EQ(causes[0].id, "clip");
  EXPECT_EQ(causes[0].evidence, "values");
  EXPECT_THAT(causes[0].points, SizeIs(12));
  ASSERT_THAT(causes[0].strength, SizeIs(1));
  ExpectHeld(causes[0].strength[0], "Vc", end);
}

// The dip need not be bell-shaped: clouds may arrive quickly and leave slowly.
TEST(TracerCauses, ADipOfAnyShapeIsOneCause) {
  SKIP_IF_SANITIZED();
  for (const double skew : {0.5, 0.0}) {
    IvCurve curve = ModuleCurve();
    const double count = static_cast<double>(curve.size());
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const double from = k / count - 0.45, side = 0.12 * (from < 0 ? 1 - skew : 1 + skew);
      const double part = std::fabs(from / side);
      if (part < 1) curve.current_A[k] -= 0.8 * std::pow(std::cos(1.5707963 * part), 2);
    }
    const std::vector<Cause> causes = CausesOf(curve);
    ASSERT_THAT(causes, SizeIs(1)) << skew;
    EXPECT_EQ(causes[0].id, "transient");
    ASSERT_THAT(causes[0].strength, SizeIs(5));
    ExpectHeld(causes[0].strength[0], "a", 0.1);
    EXPECT_NEAR(causes[0].strength[3].value, skew, 0.15);
  }
}

}  // namespace
}  // namespace lyrefit
