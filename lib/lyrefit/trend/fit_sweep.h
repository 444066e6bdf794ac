#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/model/solve.h"

namespace lyrefit {

// The model's terms of two diodes of idealities n and 2 n: light, shunt and the diodes by their
// saturation currents. `light_A` is Iph + Is1 + Is2, the current at no voltage. `nNsVth`: of the
// first diode. For PreparedBent and the kernels, which need no positive second diode.
PreparedDevice TwoDiodes(double light_A, double conductance_S, double first_A, double second_A,
                         double nNsVth);

// Two diodes of idealities n and 2 n, fitted to one sweep.
struct SweepFit {
  double photocurrent_A = kUnknown;
  double resistance_series_ohm = kUnknown;
  double shunt_conductance_S = kUnknown;
  double n = kUnknown;
  double open_circuit_V = kUnknown;  // of the sweep
  // Currents of the diodes at that voltage across the junction. That of the second may be slightly
  // negative: bounds would bias means of many sweeps.
  double diode_A = kUnknown;
  double diode_2_A = kUnknown;
  double rms_A = kUnknown;
  bool usable = false;
};

// Which parameters are fitted besides photocurrent, first diode, series resistance and shunt.
enum class SweepFree {
  kIdeality,     // n; there is no second diode
  kSecondDiode,  // at the given n
};

// Least squares of the solved current from `n` on. `thermal_V`: Ns Vt.
SweepFit FitSweep(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                  double thermal_V, double n, SweepFree free);

}  // namespace lyrefit
