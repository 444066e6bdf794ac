#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

enum class CurrentSign {
  kGenerator,  // delivered current is positive
  kLoad,       // delivered current is negative
  kUnclear,    // the readings fit neither: as if a voltage had changed its sign
};

// In which sign the currents were written. In generator sign no device delivers a negative current
// at zero volt, and current falls as voltage rises; where the first shows (measured near zero volt
// or extrapolated by the resistant line) it decides against a weak trend, such as drift on the
// flat part; dark curves show only the second.
CurrentSign DetectCurrentSign(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A);

// Brings the currents into generator sign, and says so in `assumptions` when that changed something
// or could not be decided. Voltages are never turned.
void TurnLoadSign(IvCurve* curve);

}  // namespace lyrefit
