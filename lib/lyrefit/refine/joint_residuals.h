#pragma once

#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/joint_coordinates.h"

namespace lyrefit {

// How many residuals and unknowns of its own a curve has.
struct JointShape {
  int residuals = 0;  // points, then priors
  int locals = 0;     // unknowns of its own
  bool irradiance = false;
  bool temperature = false;
};
JointShape ShapeOf(const JointCurve& curve);

// Unknowns of its own that a curve has, side by side, and back.
std::vector<double> PackLocal(const JointShape& shape, const JointLocal& local);
JointLocal UnpackLocal(const JointShape& shape, const JointLocal& packed);

// sqrt(weight) x (model - measured) of one curve in units of `unit_A`, priors behind, and the
// derivatives with respect to the shared coordinates and to the curve's own unknowns (null: not
// wanted). False where the point is no place to be. Derivatives of the solved current follow from
// the implicit function theorem at the root; those of the device's parameters with respect to the
// unknowns from dual numbers through the translation.
bool EvaluateJointCurve(const JointProblem& problem, const JointCoordinates& coordinates, int curve,
                        const double* theta, const double* local, double unit_A, double* residuals,
                        RowMatrix* shared_jacobian, RowMatrix* local_jacobian);

}  // namespace lyrefit
