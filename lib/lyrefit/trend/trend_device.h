#pragma once

#include <array>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/estimate/family/read_pvlib.h"
#include "lyrefit/read/iv_curve.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// The device whose changes are followed, by De Soto's law with one diode (model/translation.h). The
// law carries the voltage of a sweep to standard conditions: what is followed is how much the
// diode's own voltage differs from it, since n and saturation current are almost exchangeable.
struct TrendDevice {
  int cells_in_series = 1;
  int substrings = 0;  // with a bypass diode; 0: not known
  double n = 1.1;
  double bandgap_eV = 1.121;
  double bandgap_slope_per_K = -2.677e-4;
  double isc_tempco_per_K = 5e-4;
  // At 1000 W/m2 and 25 C.
  double photocurrent_A = 0;
  double resistance_series_ohm = 0;
  double ln_saturation_current = 0;  // A
  double shunt_conductance_S = 0;

  // n Ns Vt in V.
  double ThermalVoltage(double temperature_C) const;
  // ln of the saturation current at T over that at 25 C.
  double SaturationShift(double temperature_C) const;
  // A, at light `irradiance_W_m2`.
  double Photocurrent(double irradiance_W_m2, double temperature_C) const;
  // V, of the diode alone at a photocurrent.
  double OpenCircuit(double photocurrent_A, double temperature_C) const;
};

// A device in one condition.
struct TrendState {
  double photocurrent_A = 0;
  double resistance_series_ohm = 0;
  double ln_saturation_current = 0;  // in A, at the condition's temperature
  double n = 1;
  double shunt_conductance_S = 0;
};

// The device with these parameters (TrendParameter) where the law expects `expected_A` as its
// photocurrent.
TrendState StateOf(const TrendDevice& device, const std::array<double, kTrendParameters>& parameters,
                   double expected_A, double temperature_C);

// Power at maximum power in W.
double PowerOf(const TrendDevice& device, const TrendState& state, double temperature_C);

// The law of a module file. Errors: two diodes, an infinite photocurrent.
Expected<TrendDevice> DeviceOfModule(const NamedParameters& module);

// Parameters that a sweep is fitted with.
struct SweepFit {
  double photocurrent_A = kUnknown;
  double resistance_series_ohm = kUnknown;
  double ln_saturation_current = kUnknown;  // in A at the sweep's temperature
  double shunt_conductance_S = kUnknown;
  double n = kUnknown;
  double rms_A = kUnknown;
  bool usable = false;
};

// Least squares of the solved current from `n` on. `nNsVth_1`: at n = 1, in V.
SweepFit FitSweep(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                  double nNsVth_1, double n);

// The law of these sweeps, which are of one device: medians of their fits. Errors: not
// one of them can be fitted.
Expected<TrendDevice> DeviceOfSweeps(const std::vector<const IvCurve*>& sweeps);

// The row of a sweep at the conditions stated for it: parameters at standard conditions, key points,
// lost substrings. Without the expected power and the parts of the loss.
TrendRow ReduceSweep(const TrendDevice& device, const IvCurve& curve, double time_s);

}  // namespace lyrefit
