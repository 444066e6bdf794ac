#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Diodes so steep that the law cuts their exponents off (model/term.h). Such a diode is a step in the
// current, which could fit any data and is no diode. Searches and their references leave them out.

// Smallest n, per cell, at which no exponent is cut off at any reading, with Rs in its range.
double SteepestIdeality(const IvCurve& curve, const Device& device, const ParameterBounds& rs);

// Raises the lower bounds of n to that n where they begin below it. `bounds` and `fixed` (NaN: free)
// are in the order of the device; a fixed n keeps its bounds. Returns the raised bound; NaN: none
// was raised.
double LeaveOutSteps(const IvCurve& curve, const Device& device, const std::vector<double>& fixed,
                     std::vector<ParameterBounds>* bounds);

// Sentence on bounds that were raised to `steepest_n`, without its full stop.
std::string StepsLeftOut(double steepest_n);

}  // namespace lyrefit
