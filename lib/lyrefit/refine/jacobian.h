#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/refine/problem.h"

namespace lyrefit {

// Residuals sqrt(weight) x (model - measured) in ampere and their derivatives with respect to the
// polish coordinates (see Coordinates) of the parameters that are not held, at `p`.
struct Linearization {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;    // points x moving
  std::vector<int> parameter;  // of each column
  // Derivative of each natural parameter with respect to each coordinate: parameters x moving.
  Eigen::MatrixXd parameter_slope;
};

Linearization Linearize(const RefineProblem& problem, const std::vector<double>& p,
                        const std::vector<bool>& held);

}  // namespace lyrefit
