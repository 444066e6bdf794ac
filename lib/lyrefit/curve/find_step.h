#pragma once

#include <optional>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Where the current falls with voltage and then holds, which no diodes in parallel do: a bypass
// diode that conducts, a change of the light.
struct CurveStep {
  double voltage_V = 0;  // where the fall ends
  double depth_A = 0;    // how far the curve hangs below the concave one over it
};

// The deepest step of a curve at forward voltage, if it is one: 2 % of the largest current deep and
// six times the noise, and not of one reading alone. A diode model's current is concave in the
// voltage, so the curve is compared with its upper convex hull.
std::optional<CurveStep> FindStep(const IvCurve& curve);

}  // namespace lyrefit
