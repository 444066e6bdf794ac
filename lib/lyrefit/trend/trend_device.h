#pragma once

#include <array>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// The device whose changes are followed: two diodes, of idealities n and 2 n, whose saturation
// currents follow temperature as in model/translation.h (De Soto; (T/Tref)^(5/2) and half the band
// gap for the second). Without its second diode a module whose recombination grows seems to change
// its series resistance. The law carries the voltage of a sweep to standard conditions: what is
// followed is how much the diodes' own voltage differs from it, and the share of the second diode,
// since saturation currents alone are almost exchangeable.
struct TrendDevice {
  int cells_in_series = 1;
  int substrings = 0;  // with a bypass diode; 0: not known
  double n = 1;        // of the first diode
  double bandgap_eV = 1.121;
  double bandgap_slope_per_K = -2.677e-4;
  double isc_tempco_per_K = 5e-4;
  // At 1000 W/m2 and 25 C.
  double photocurrent_A = 0;
  double resistance_series_ohm = 0;
  double saturation_current_A = 0;
  double saturation_current_2_A = 0;
  double shunt_conductance_S = 0;

  // n Ns Vt in V.
  double ThermalVoltage(double temperature_C) const;
  // A, at light `irradiance_W_m2`.
  double Photocurrent(double irradiance_W_m2, double temperature_C) const;
  // V, of the diodes alone at a photocurrent.
  double OpenCircuit(double photocurrent_A, double temperature_C) const;
};

// A device at one irradiance and temperature, after some time of use.
struct DeviceState {
  double photocurrent_A = 0;
  double resistance_series_ohm = 0;
  double saturation_current_A = 0;
  double saturation_current_2_A = 0;
  double shunt_conductance_S = 0;
};

// The device with these parameters (TrendParameter) where the law expects `expected_A` as its
// photocurrent.
DeviceState StateOf(const TrendDevice& device,
                    const std::array<double, kTrendParameters>& parameters, double expected_A,
                    double temperature_C);

// A point of a device's curve.
struct TrendPoint {
  double voltage_V = 0;
  double current_A = 0;

  double power_W() const { return voltage_V * current_A; }
};

// The point of maximum power.
TrendPoint MaximumPowerPoint(const TrendDevice& device, const DeviceState& state,
                             double temperature_C);

// The law of a module file, with one diode. Errors: two diodes, no photocurrent.
Expected<TrendDevice> DeviceOfModule(const NamedParameters& module);

// The law of these sweeps, which are of one device: medians of their fits. Errors: not one of them
// can be fitted.
Expected<TrendDevice> DeviceOfSweeps(const std::vector<const IvCurve*>& sweeps);

// The row of a sweep at the conditions stated for it: parameters, key points, lost substrings.
// Without the expected power and the parts of the loss.
TrendRow ReduceSweep(const TrendDevice& device, const IvCurve& curve, double time_s);

}  // namespace lyrefit
