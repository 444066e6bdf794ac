#pragma once

#include <Eigen/Core>

namespace lyrefit {

// Minimises |a x - b| over lower <= x <= upper by active sets (Lawson and Hanson 1974, chapter 23).
// `a` is m x n, `b` has m elements, the others n. Infinite bounds are open, and `x` is a feasible
// start. Unknowns that start at a bound are free in the first step, whatever their gradient:
// rounding hides the gradient of a column that is nearly parallel to another. Meant for a handful
// of columns of similar length.
Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             Eigen::VectorXd x);

}  // namespace lyrefit
