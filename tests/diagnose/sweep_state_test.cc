#include "lyrefit/diagnose/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

Recipe PlainModule() {
  Recipe recipe;
  recipe.cells = 60;
  recipe.irradiance_W_m2 = 800;
  recipe.noise_A = 1e-5;
  return recipe;
}

TEST(FitSweep, FindsTheDeviceThatMadeTheSweep) {
  const auto sweep = FitSweep(SyntheticCurve(PlainModule()));
  ASSERT_TRUE(sweep) << sweep.error().message;
  const SweepState& state = sweep->state;
  EXPECT_EQ(state.cells, 60);
  EXPECT_EQ(state.irradiance_W_m2, 800);
  EXPECT_NEAR(state.photocurrent_A, 6.4, 1e-3);
  EXPECT_NEAR(state.ideality, 1.2, 1e-3);
  EXPECT_NEAR(state.series_ohm, 0.24, 1e-3);
  EXPECT_NEAR(state.shunt_S, 1.0 / 1200, 2e-5);
  EXPECT_NEAR(state.max_power_W, state.fill_factor * state.isc_A * state.voc_V, 1e-9);
  EXPECT_LT(state.shape.cwiseAbs().maxCoeff(), 1e-4);
}

TEST(FitSweep, SeesTheShapeOfWhatTheDiodeMisses) {
  IvCurve curve = SyntheticCurve(PlainModule());
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] += 0.05 * std::sin(20 * curve.voltage_V[k] / 37);
  }
  const auto sweep = FitSweep(curve);
  ASSERT_TRUE(sweep) << sweep.error().message;
  EXPECT_GT(sweep->state.shape.cwiseAbs().maxCoeff(), 2e-3);
}

TEST(FitSweep, RefusesWhatIsNoSweepOfAModuleInTheLight) {
  EXPECT_THAT(FitSweep(SyntheticDarkCurve()).error().message, HasSubstr("dark"));
  IvCurve dead = SyntheticCurve(PlainModule());
  dead.name = "dead";
  for (double& current : dead.current_A) current = 0;
  EXPECT_THAT(FitSweep(dead).error().message, HasSubstr("dead"));
  Recipe reverse = PlainModule();
  reverse.from_V = -0.5;
  reverse.to_V = 0.2;
  EXPECT_FALSE(FitSweep(SyntheticCurve(reverse)) &&
               FitSweep(SyntheticCurve(reverse))->state.voc_V < 1);
}

TEST(StateWith, FollowsWhatIsDoneToTheReadings) {
  const auto sweep = FitSweep(SyntheticCurve(PlainModule()));
  ASSERT_TRUE(sweep) << sweep.error().message;
  const Readings& readings = *sweep->weighted.readings;
  std::vector<double> change(readings.points.size(), 0.0);
  EXPECT_NEAR(StateWith(*sweep, change).series_ohm, sweep->state.series_ohm, 1e-6);
  for (std::size_t k = 0; k < change.size(); ++k) {
    change[k] = -0.02 * readings.points[k].voltage / readings.traits.open_circuit;
  }
  const SweepState leaky = StateWith(*sweep, change);
  const double ohm = leaky.voc_V / leaky.isc_A;
  EXPECT_NEAR((leaky.shunt_S - sweep->state.shunt_S) * ohm, 0.02, 2e-3);
}

}  // namespace
}  // namespace lyrefit
