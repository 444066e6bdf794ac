#include "lyrefit/translate/procedure_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "synthetic_string.h"

namespace lyrefit {
namespace {

TEST(E1036, MeetsTheModelWhereReadingsAreExact) {
  const SyntheticModule module;
  const KeyPoints truth = module.Truth(1000, 25);
  const CurvePoints points = module.Readings(1000, 25, 100);
  const KeyPoints found = E1036KeyPoints(points.voltage_V, points.current_A);
  EXPECT_NEAR(found.short_circuit_current_A, truth.short_circuit_current_A, 1e-3);
  EXPECT_NEAR(found.open_circuit_voltage_V, truth.open_circuit_voltage_V, 0.05);
  EXPECT_NEAR(found.max_power_W, truth.max_power_W, 2e-3 * truth.max_power_W);
  EXPECT_NEAR(found.max_power_voltage_V, truth.max_power_voltage_V, 0.3);
}

// E1036 windows average over many readings, which lowers the scatter of Pmax.
TEST(E1036, ScattersLessThanSingleReadings) {
  const SyntheticModule module;
  const CurvePoints clean = module.Readings(1000, 25, 100);
  const KeyPoints truth = E1036KeyPoints(clean.voltage_V, clean.current_A);
  const KeyPoints read = FindKeyPoints(clean.voltage_V, clean.current_A);
  double windows = 0, single = 0;
  for (int seed = 0; seed < 50; ++seed) {
    RandomStream random(seed);
    CurvePoints noisy = clean;
    for (double& current : noisy.current_A) current += 0.02 * random.Normal();
    const auto square = [](double x) { return x * x; };
    windows +=
        square(E1036KeyPoints(noisy.voltage_V, noisy.current_A).max_power_W - truth.max_power_W);
    single +=
        square(FindKeyPoints(noisy.voltage_V, noisy.current_A).max_power_W - read.max_power_W);
  }
  EXPECT_LT(windows, 0.5 * single);
}

TEST(E1036, KeepsToTheReadingsWhereWindowsAreEmpty) {
  const std::vector<double> voltage_V = {0, 10, 20}, current_A = {5, 4.5, 0};
  const KeyPoints found = E1036KeyPoints(voltage_V, current_A);
  const KeyPoints plain = FindKeyPoints(voltage_V, current_A);
  EXPECT_EQ(found.max_power_W, plain.max_power_W);
  EXPECT_EQ(found.open_circuit_voltage_V, plain.open_circuit_voltage_V);
  EXPECT_TRUE(std::isnan(E1036KeyPoints({}, {}).max_power_W));
}

}  // namespace
}  // namespace lyrefit
