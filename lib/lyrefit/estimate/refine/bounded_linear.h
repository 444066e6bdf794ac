#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/estimate/refine/problem.h"

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

// The linear part of the measured-current problem at given Rs and n: minimise the sum of weight x
// (Iph - G Vd - sum Is (exp(Vd / (n Ns Vt)) - 1) - I)^2 within the bounds of Iph, G = 1/Rsh and Is.
// Columns are scaled to a largest entry of 1 and multiplied by sqrt(weight).
struct LinearPart {
  Eigen::VectorXd vd;        // junction voltage
  Eigen::VectorXd root;      // sqrt(weight)
  Eigen::MatrixXd columns;   // points x (2 + diodes): Iph, G, then the diodes
  Eigen::VectorXd target;    // sqrt(weight) x measured current
  Eigen::VectorXd scale;     // natural value = x / scale
  SmallVector x;             // the solution, scaled
  Eigen::VectorXd residual;  // columns x - target
  SmallMatrix gram;          // columns' columns
  std::vector<int> free;     // columns that are not at a bound
};

// Columns for an Rs and a list of n, which may be longer than the device's number of diodes.
LinearPart MakeLinearColumns(const RefineProblem& problem, const std::vector<double>& weights,
                             double rs, const std::vector<double>& idealities);

// Bounds of the scaled unknowns; column 2 + d belongs to diode d.
void LinearBounds(const RefineProblem& problem, const Eigen::VectorXd& scale, SmallVector* lower,
                  SmallVector* upper);

// Columns and solution for one n per diode.
LinearPart SolveLinearPart(const RefineProblem& problem, const std::vector<double>& weights,
                           double rs, const std::vector<double>& idealities);

// The device's parameter vector of a solution.
std::vector<double> ToParameters(const RefineProblem& problem, const LinearPart& linear, double rs,
                                 const std::vector<double>& idealities);

}  // namespace lyrefit
