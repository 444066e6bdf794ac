#include "lyrefit/trend/fit_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trend/made_sweeps.h"

namespace lyrefit {
namespace {

double ThermalAt(const TrendDevice& device, double temperature_C) {
  return device.ThermalVoltage(temperature_C) / device.n;
}

TEST(FitSweep, RecoversTwoDiodesThatWereMade) {
  const TrendDevice device = MadeDevice();
  for (const auto& [irradiance, temperature_C] :
       {std::pair{1000.0, 25.0}, {800.0, 55.0}, {300.0, 20.0}}) {
    const DeviceState state = MadeState(device, irradiance, temperature_C);
    const IvCurve curve = MadeSweep(device, state, irradiance, temperature_C);
    const SweepFit fit = FitSweep(curve.voltage_V, curve.current_A,
                                  ThermalAt(device, temperature_C), 1, SweepFree::kSecondDiode);
    ASSERT_TRUE(fit.usable);
    EXPECT_NEAR(fit.photocurrent_A, state.photocurrent_A, 1e-6 * state.photocurrent_A);
    EXPECT_NEAR(fit.resistance_series_ohm, 0.3, 1e-5);
    EXPECT_NEAR(fit.shunt_conductance_S, 1 / 400.0, 1e-6);
    EXPECT_EQ(fit.n, 1);
    const double half = std::exp(0.5 * fit.open_circuit_V / device.ThermalVoltage(temperature_C));
    EXPECT_NEAR(fit.diode_A, state.saturation_current_A * half * half, 1e-4 * fit.diode_A);
    EXPECT_NEAR(fit.diode_2_A, state.saturation_current_2_A * half, 1e-3 * fit.diode_2_A);
    EXPECT_LT(fit.rms_A, 1e-7);
  }
}

TEST(FitSweep, FindsTheIdealityOfASingleDiode) {
  TrendDevice device = MadeDevice();
  device.n = 1.27;
  device.saturation_current_A = 4e-8;
  device.saturation_current_2_A = 0;
  const IvCurve curve = MadeSweep(device, MadeState(device, 900, 40), 900, 40);
  const SweepFit fit =
      FitSweep(curve.voltage_V, curve.current_A, ThermalAt(device, 40), 1.1, SweepFree::kIdeality);
  ASSERT_TRUE(fit.usable);
  EXPECT_NEAR(fit.n, 1.27, 1e-4);
  EXPECT_NEAR(fit.resistance_series_ohm, 0.3, 1e-4);
  EXPECT_EQ(fit.diode_2_A, 0);
}

TEST(FitSweep, OrderOfTheReadingsDoesNotMatter) {
  const TrendDevice device = MadeDevice();
  IvCurve curve = MadeSweep(device, MadeState(device, 900, 40), 900, 40);
  const SweepFit up =
      FitSweep(curve.voltage_V, curve.current_A, ThermalAt(device, 40), 1, SweepFree::kSecondDiode);
  std::reverse(curve.voltage_V.begin(), curve.voltage_V.end());
  std::reverse(curve.current_A.begin(), curve.current_A.end());
  const SweepFit down =
      FitSweep(curve.voltage_V, curve.current_A, ThermalAt(device, 40), 1, SweepFree::kSecondDiode);
  ASSERT_TRUE(down.usable);
  EXPECT_NEAR(down.resistance_series_ohm, up.resistance_series_ohm, 1e-6);
  EXPECT_NEAR(down.photocurrent_A, up.photocurrent_A, 1e-6);
}

TEST(FitSweep, SaysThatReadingsAreNoSweep) {
  const std::vector<double> volts = {0, 5, 10, 15, 20, 25, 30, 35, 40};
  EXPECT_FALSE(FitSweep(volts, std::vector<double>(9, 0), 1.5, 1, SweepFree::kSecondDiode).usable);
  EXPECT_FALSE(FitSweep(volts, std::vector<double>(9, 5), 1.5, 1, SweepFree::kSecondDiode).usable);
  EXPECT_FALSE(FitSweep({}, {}, 1.5, 1, SweepFree::kSecondDiode).usable);
  EXPECT_FALSE(FitSweep({30}, {5}, 1.5, 1, SweepFree::kIdeality).usable);
}

}  // namespace
}  // namespace lyrefit
