#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/active_set.h"

namespace lyrefit {

// Linearised uncertainty at the end of a fit: the inverse of J'J times the residual variance, in
// the parameters that are not held, the blocks' own unknowns eliminated. It assumes independent
// noise of constant (weighted) size and a model that is right; parameters at a bound are taken as
// known, so profiles must back it up there. What moves along a direction without influence on any
// residual has no standard error; the others keep theirs.
struct Spread {
  std::vector<double> standard_error;  // of each natural parameter; NaN: held or undetermined
  Eigen::MatrixXd correlation;         // parameters x parameters, 0 where not known
  // Of the natural parameters, from the directions that the data decide; and a column of `open` for
  // every direction along which no residual changes.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd open;
  std::vector<double> local_error;  // of the blocks' own unknowns, in their order
  double condition = 1;             // of the Jacobian with columns of length 1
};

// `variance`: of a residual, in A^2.
Spread FindSpread(const FitModel& model, const FitPoint& point, const std::vector<bool>& held,
                  double variance);

// The same of the same fit where the residuals' errors are others than its weights take them for:
// (J'J)^-1 J'CJ (J'J)^-1 with their covariance C, in A, of which nothing but its product with rows,
// one for each residual, is asked. Without errors of the blocks' own unknowns.
using CovarianceProduct = std::function<RowMatrix(const RowMatrix&)>;
Spread FindSpread(const FitModel& model, const FitPoint& point, const std::vector<bool>& held,
                  const CovarianceProduct& covariance_times);

}  // namespace lyrefit
