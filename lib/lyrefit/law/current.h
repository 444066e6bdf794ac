#pragma once

#include "lyrefit/law/device.h"

namespace lyrefit {

// A point on the device's own curve.
struct OperatingPoint {
  double current_A;
  double junction_voltage_V;
  double conductance_S;  // dF/dVd at the junction, never positive for a passive device
};

// The root of I = F(V + I Rs) at terminal voltage V: safeguarded Newton on the junction voltage,
// error about 1e-15 of |I| + Iph, no failure and no NaN for any finite parameters in their physical
// range.
OperatingPoint SolveOperatingPoint(const Device& device, const double* p, double voltage_V);

// Root mean square of both residuals over the points, unweighted, in ampere. Labels matter: see
// Objective.
double Rmse(const Device& device, Objective objective, const double* p,
            const std::vector<double>& voltage_V, const std::vector<double>& current_A);

// The point on the curve where the current is known to be `current_A` already.
OperatingPoint KnownOperatingPoint(const Device& device, const double* p, double voltage_V,
                                   double current_A);

// dI/dp of the solved current by the implicit function theorem, given the derivatives of the
// explicit right-hand side at the solved current (dF: with Vd = V + I Rs and I held): dI = dF / (1
// - Rs F').
inline double ImplicitFactor(const Device& device, const double* p, const OperatingPoint& point) {
  return 1.0 / (1.0 - p[device.resistance_series] * point.conductance_S);
}

}  // namespace lyrefit
