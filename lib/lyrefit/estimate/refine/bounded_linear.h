#pragma once

#include <Eigen/Core>

namespace lyrefit {

// Largest number of linear unknowns: Iph, 1/Rsh and one per diode, with some to spare.
constexpr int kMostLinear = 8;
using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostLinear, kMostLinear>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostLinear, 1>;

// Both functions return the x that minimises |A x - b|^2 over lower <= x <= upper. They use the
// active-set method of Lawson and Hanson (1974, chapter 23) with two-sided bounds (Stark and Parker
// 1995). Columns should be scaled to similar length.

// Fast, for at most kMostLinear unknowns with finite bounds: takes the Gram matrix G = A'A and A'b.
// The normal equations lose the digits of columns that are nearly parallel. All unknowns start at
// their lower bounds. The objective less |b|^2 is x'G x - 2 x'A'b.
SmallVector SolveBoundedLinear(const SmallMatrix& gram, const SmallVector& atb,
                               const SmallVector& lower, const SmallVector& upper);

// Exact to rounding, for any number of unknowns: decomposes the columns of A by QR. Infinite bounds
// are open, and `x` is a feasible start. All unknowns are free in the first step, whatever their
// gradient: rounding hides the gradient of a column that is nearly parallel to another.
Eigen::VectorXd SolveBoundedColumns(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                    Eigen::VectorXd x);

}  // namespace lyrefit
