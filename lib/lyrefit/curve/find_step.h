#pragma once

#include <optional>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// A step: the current falls with voltage and then stays level. Diodes in parallel cannot cause it;
// a conducting bypass diode or a change of irradiance can.
struct CurveStep {
  double voltage_V = 0;  // where the fall ends
  double depth_A = 0;    // distance below the upper convex hull of the curve
};

// Finds the deepest step of a curve at forward voltage. The depth must exceed 2 % of the largest
// current and six times the noise, and a single reading does not count. The current of a diode
// model is concave in the voltage, so the curve is compared with its upper convex hull.
std::optional<CurveStep> FindStep(const IvCurve& curve);

}  // namespace lyrefit
