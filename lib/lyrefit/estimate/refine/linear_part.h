#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/estimate/refine/bounded_linear.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

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
