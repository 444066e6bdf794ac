#pragma once

#include <Eigen/Core>

namespace lyrefit {

// Minimises |a x - b| over x >= 0 (Lawson and Hanson 1974, chapter 23) from a feasible start; its
// zeros may enter at once, without being priced, since rounding hides what a column next to another
// one has to give. For a handful of columns, which should be of similar length.
Eigen::VectorXd SolveNonNegative(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                 Eigen::VectorXd x);

}  // namespace lyrefit
