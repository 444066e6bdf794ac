#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/law/device.h"

namespace lyrefit {

// Some publications solve the diode equation by a single step of Newton's method from the measured
// current and call the end of that step the calculated current:
//
//   r = (F(V, I) - I) / (1 + Rs (dF/dVd)),   I measured, F the right-hand side
//
// It differs from the solved current in the second order of r, so the least RMSE of the step lies a
// little beside the least there is of the solved current, on either side.

// RMSE of that step for the parameters of a device, in the device's order; infinite where a number
// overflows.
double NewtonStepRmse(const Device& device, const std::vector<double>& parameters,
                      const IvCurve& curve);

// The least of it that a descent from `start` finds, currents and conductance not negative and n
// between these bounds.
double LeastNewtonStepRmse(const Device& device, const std::vector<double>& start, double n_lower,
                           double n_upper, const IvCurve& curve);

}  // namespace lyrefit
