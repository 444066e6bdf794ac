#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

enum class CurrentSign {
  kGenerator,  // delivered current is positive
  kLoad,       // delivered current is negative
  kUnclear,    // the readings fit neither, as if the voltage had the wrong sign
};

// Determines the sign convention of the currents. In generator sign no device has a negative
// current at zero volt, and the current falls as the voltage rises. The current at zero volt
// decides if it is clearly nonzero. It is read near zero volt, or extrapolated by Tukey's resistant
// line. It overrules a weak trend, such as drift on the flat part; a strong contrary trend gives
// kUnclear. Dark curves have no such current; their trend decides.
CurrentSign DetectCurrentSign(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A);

// Converts the currents to generator sign. `assumptions` records a change, and a sign that could
// not be determined. Voltages are never negated.
void TurnLoadSign(IvCurve* curve);

}  // namespace lyrefit
