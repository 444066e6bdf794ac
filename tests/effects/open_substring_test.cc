#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/brute_module.h"

namespace lyrefit {
namespace {

TEST(OpenSubstringTest, IsTheSumOfItsCellsAndDiodes) {
  // A substring of dark cells without a leak: its diode carries all current.
  Readings readings = SyntheticReadings(DataKind::kForward, 60);
  for (Reading& reading : readings.points) reading.voltage *= 2.0 / 3;
  BruteModule module(readings, {{{{{40, 1, 0}}}, false}});
  const Settled at = WithEffect(*FindEffect("open_substring"), {1.0 / 3, 0.4, 1.7}, readings);
  const std::vector<double> current = Currents(at.law, readings, at.p);
  ASSERT_EQ(current.size(), readings.points.size());
  const double scale = 1.7 * ThermalVoltage(readings.reference_temperature_K);
  const double saturation = std::exp(-0.4 / scale);
  for (std::size_t k = 0; k < current.size(); ++k) {
    if (current[k] < 1e-3) continue;  // beyond open circuit the dark cells conduct
    // The shunts of the dark cells carry up to 1e-3 beside the diode.
    const double drop = scale * std::log1p(current[k] / saturation);
    const double expected = module.Current(60 * readings.points[k].voltage + drop);
    EXPECT_NEAR(current[k], expected, 1e-3) << k;
  }
}

TEST(OpenSubstringTest, TriesSharesThatLeaveUsualCells) {
  DataTraits traits = SyntheticReadings(DataKind::kForward, 60).traits;
  traits.open_circuit = 0.4;  // of all cells: 0.6 V of two of three substrings
  const Effect& effect = *FindEffect("open_substring");
  const std::vector<Probe> probes = effect.probes(traits);
  ASSERT_EQ(probes.size(), 1U);
  EXPECT_NEAR(probes[0][0], 1.0 / 3, 1e-12);
  // One of twelve modules of three substrings.
  traits.cells = 720;
  traits.substrings = 36;
  traits.open_circuit = 0.6 * 11 / 12;
  const auto one_module = [](const Probe& probe) { return std::fabs(probe[0] - 3.0 / 36) < 1e-9; };
  const std::vector<Probe> many = effect.probes(traits);
  EXPECT_TRUE(std::any_of(many.begin(), many.end(), one_module));
}

}  // namespace
}  // namespace lyrefit
