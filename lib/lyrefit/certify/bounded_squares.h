#pragma once

#include <Eigen/Core>

namespace lyrefit {

// Minimises |a x - b| over lower <= x <= upper (infinite: open) from a feasible start, by active
// sets (Lawson and Hanson 1974, chapter 23);
// unknowns at an end of their range may leave it at once, without being priced, since rounding
// hides what a column next to another one has to give. For a handful of columns, which should be of
// similar length.
Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             Eigen::VectorXd x);

}  // namespace lyrefit
