#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Some publications solve the diode equation by a single step of Newton's method from the measured
// current. They call the result of that step the calculated current. Its residual is
//
//   r = (F(V, I) - I) / (1 + Rs (dF/dVd)),   I measured, F the right-hand side
//
// It differs from the residual of the solved current in the second order of r. The least RMSE of
// the step is therefore slightly above or below the least RMSE of the solved current.

// RMSE of that Newton step in ampere. `parameters` are in the device's order. Infinite on overflow.
double NewtonStepRmse(const Device& device, const std::vector<double>& parameters,
                      const IvCurve& curve);

// The least RMSE of that Newton step that a descent from `start` finds, in ampere. Currents and
// shunt conductance are not negative, and n lies between the given bounds.
double LeastNewtonStepRmse(const Device& device, const std::vector<double>& start, double n_lower,
                           double n_upper, const IvCurve& curve);

}  // namespace lyrefit
