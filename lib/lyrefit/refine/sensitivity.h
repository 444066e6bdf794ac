#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/refine/problem.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// Linearised uncertainty at the end of a polish: the inverse of J'J times the residual variance, in
// the parameters that are not held. It assumes independent noise of constant (weighted) size in the
// current and a model that is right; parameters at a bound are taken as known, so profiles must
// back it up there.
struct Sensitivity {
  std::vector<double> standard_error;  // of each natural parameter, NaN where held or singular
  Eigen::MatrixXd correlation;         // parameters x parameters, 0 where not known
  double condition = 1;                // of the Jacobian with columns of length 1
};

// `degrees_of_freedom`: points less free parameters, at least 1.
Sensitivity FindSensitivity(const RefineProblem& problem, const RefineEnd& end,
                            int degrees_of_freedom);

}  // namespace lyrefit
