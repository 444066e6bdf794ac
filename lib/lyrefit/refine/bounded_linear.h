#pragma once

#include <Eigen/Core>

namespace lyrefit {

// Minimises |A x - b|^2 over lower <= x <= upper, given the Gram matrix G = A'A and A'b: an active-set
// method for a handful of variables (Stark and Parker 1995, "Bounded-variable least squares", on the
// normal equations). Columns should be scaled to similar length. Returns x; the value of the objective
// less |b|^2 is x'G x - 2 x'A'b.
Eigen::VectorXd SolveBoundedLinear(const Eigen::MatrixXd& gram, const Eigen::VectorXd& atb,
                                   const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace lyrefit
