#pragma once

#include <vector>

#include "lyrefit/law/device.h"
#include "lyrefit/law/kernel.h"

namespace lyrefit {

// Points of a curve as they were measured, and as the kernels take them.
struct CurvePoints {
  const std::vector<double>& voltage_V;
  const std::vector<double>& current_A;
  const PointSet& set;
};

// What the residuals of an objective take the measured current from, at every point: the explicit
// right-hand side at the measured current, or the solved current. Where `slopes` is given, its
// derivatives by the device's parameters, row by row: those of the explicit right-hand side, at the
// root divided by 1 - Rs F' (the implicit function theorem; differentiating the Newton iteration
// would cost more and be less exact). NaN where an extended law cannot be evaluated.
void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const CurvePoints& points, const Kernel& kernel, double* current,
                   double* slopes);

}  // namespace lyrefit
