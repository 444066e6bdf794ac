#pragma once

#include "lyrefit/model/device.h"

namespace lyrefit {

// A point on the device's own curve.
struct OperatingPoint {
  double current_A;
  double junction_voltage_V;
  double conductance_S;  // dF/dVd at the junction, never positive for a passive device
};

// Solves I = F(V + I Rs) at terminal voltage V by safeguarded Newton on the junction voltage. The
// error is about 1e-15 of |I| + Iph. The solver never fails and gives no NaN for finite parameters
// in their physical range.
OperatingPoint SolveOperatingPoint(const Device& device, const double* p, double voltage_V);

// Unweighted root mean square of the residual that `objective` selects, in ampere. RMSE values of
// different objectives are not comparable: see Objective.
double Rmse(const Device& device, Objective objective, const double* p,
            const std::vector<double>& voltage_V, const std::vector<double>& current_A);

// The operating point at terminal voltage V whose current `current_A` is known, without a solve.
OperatingPoint KnownOperatingPoint(const Device& device, const double* p, double voltage_V,
                                   double current_A);

// Factor of the implicit function theorem, dI = dF / (1 - Rs F'). dF is the derivative of the
// right-hand side F(V + I Rs) by a parameter, with Vd = V + I Rs and I fixed.
inline double ImplicitFactor(const Device& device, const double* p, const OperatingPoint& point) {
  return 1.0 / (1.0 - p[device.resistance_series] * point.conductance_S);
}

}  // namespace lyrefit
