#pragma once

#include <vector>

#include "lyrefit/law/device.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/law/law.h"

namespace lyrefit {

// Points of a curve as they were measured, and as the kernels take them.
struct CurveView {
  const std::vector<double>& voltage_V;
  const std::vector<double>& current_A;
  const PointSet& set;
};

// What the residuals of an objective take the measured current from, at every point: the explicit
// right-hand side at the measured current, or the solved current. Where `slopes` is given, its
// derivatives by the device's parameters, row by row: those of the explicit right-hand side, at the
// root divided by 1 - Rs F' (the implicit function theorem; differentiating the Newton iteration
// would cost more and be less exact). NaN where an extended law cannot be evaluated. Such a law
// leaves out the derivatives by what is `held` (1), which are 0 then, and may have a workspace that
// is kept from one call to the next.
void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const CurveView& points, const Kernel& kernel, double* current, double* slopes,
                   const std::vector<char>* held = nullptr, LawWorkspace* kept = nullptr);

}  // namespace lyrefit
