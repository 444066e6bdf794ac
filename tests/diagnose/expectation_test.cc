#include "lyrefit/diagnose/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;

// A sweep whose parameters follow irradiance and voltage. Errors of n and Rs are correlated, as in
// fits.
SweepState SyntheticState(RandomStream* random) {
  SweepState state;
  state.isc_A = 8 * (1 + 0.1 * random->Normal());
  state.voc_V = 36 * (1 + 0.01 * random->Normal());
  const double light = std::log(state.isc_A / 8), voltage = state.voc_V - 36;
  const double ohm = state.voc_V / state.isc_A, shared = random->Normal();
  state.fill_factor = 0.72 * std::exp(-0.08 * light + 0.01 * voltage + 1e-3 * random->Normal());
  state.ideality = 1.2 + 0.03 * light + 0.02 * shared;
  state.series_ohm = ohm * (0.08 + 0.05 * light - 2e-3 * shared + 4e-4 * random->Normal());
  state.shunt_S = (0.01 + 1e-3 * random->Normal()) / ohm;
  state.shape.resize(kShapeBins);
  for (double& off : state.shape) off = 1e-3 + 2e-4 * random->Normal();
  return state;
}

std::vector<const SweepState*> Pointers(const std::vector<SweepState>& states) {
  std::vector<const SweepState*> pointers;
  for (const SweepState& state : states) pointers.push_back(&state);
  return pointers;
}

std::vector<SweepState> SyntheticStates(int count, RandomStream* random) {
  std::vector<SweepState> states;
  for (int k = 0; k < count; ++k) states.push_back(SyntheticState(random));
  return states;
}

// Fraction of reference sweeps that Differ() finds different at the significance `level`.
double FalseAlarms(int references, double level, std::uint64_t seed) {
  constexpr int kSweeps = 400;
  RandomStream random(seed);
  int alarms = 0;
  for (int k = 0; k < kSweeps; ++k) {
    const auto states = SyntheticStates(references, &random);
    const SweepState sweep = SyntheticState(&random);
    alarms += Differ(Expect(Pointers(states), sweep), sweep).p_value < level ? 1 : 0;
  }
  return static_cast<double>(alarms) / kSweeps;
}

TEST(Differ, RaisesFalseAlarmsAtItsLevel) {
  SKIP_IF_SANITIZED();
  for (const int references : {4, 8, 14, 30}) {
    const double rate = FalseAlarms(references, 0.05, 10 + references);
    EXPECT_LT(rate, 0.08) << references;
    EXPECT_GT(rate, 0.005) << references;
  }
}

TEST(Differ, SeesWhatNoParameterShowsByItself) {
  RandomStream random(3);
  const auto states = SyntheticStates(30, &random);
  SweepState sweep = SyntheticState(&random);
  const Difference before = Differ(Expect(Pointers(states), sweep), sweep);
  // In reference sweeps n and Rs are negatively correlated; here both rise.
  sweep.ideality += 0.02;
  sweep.series_ohm += 2.5e-3 * sweep.voc_V / sweep.isc_A;
  const Difference after = Differ(Expect(Pointers(states), sweep), sweep);
  EXPECT_GT(before.p_value, 0.05);
  EXPECT_LT(after.p_value, 1e-3);
}

TEST(Expect, LeavesOutTheOutlierOnes) {
  RandomStream random(4);
  auto states = SyntheticStates(20, &random);
  states[7].fill_factor *= 0.97;
  states[12].shape *= -20;
  const SweepState sweep = SyntheticState(&random);
  const Expectation e = Expect(Pointers(states), sweep);
  std::vector<int> outliers = e.outliers;
  std::sort(outliers.begin(), outliers.end());
  EXPECT_THAT(outliers, ElementsAre(7, 12));
  EXPECT_EQ(e.regressors, 3);
  EXPECT_EQ(e.degrees, 15);
}

TEST(Expect, TakesTheNearestWhereThereAreMany) {
  RandomStream random(5);
  auto states = SyntheticStates(80, &random);
  for (int k = 40; k < 80; ++k) states[k].isc_A *= 0.4;
  SweepState sweep = SyntheticState(&random);
  for (const int k : Expect(Pointers(states), sweep).used) EXPECT_LT(k, 40);
}

TEST(Expect, RegressesOnlyAsFarAsTheReferencesBear) {
  RandomStream random(6);
  const SweepState sweep = SyntheticState(&random);
  const auto four = SyntheticStates(4, &random);
  EXPECT_EQ(Expect(Pointers(four), sweep).regressors, 1);
  const auto eight = SyntheticStates(8, &random);
  EXPECT_EQ(Expect(Pointers(eight), sweep).regressors, 2);
}

}  // namespace
}  // namespace lyrefit
