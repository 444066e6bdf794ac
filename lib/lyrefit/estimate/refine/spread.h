#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/active_set.h"

namespace lyrefit {

// Linearised uncertainty at the end of a fit: the inverse of J'J times the residual variance, in
// the parameters that are free to move, with the local unknowns eliminated. It assumes independent
// noise of constant (weighted) size and a correct model. Parameters at a bound count as known, so
// profiles must check it there. A parameter that moves along a direction without influence on any
// residual has no standard error; the others keep theirs.
struct Spread {
  std::vector<double>
      standard_error;  // of each natural parameter; NaN: at an active bound or undetermined
  Eigen::MatrixXd correlation;  // parameters x parameters, 0 if unknown
  // `covariance` of the natural parameters along the directions determined by the data. `open` has
  // one column for every direction along which no residual changes.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd open;
  std::vector<double> local_error;  // of the blocks' local unknowns, in their order
  double condition = 1;             // of the Jacobian with columns of length 1
};

// `variance`: of a residual of weight 1, in A^2.
Spread FindSpread(const FitModel& model, const FitPoint& point, const std::vector<bool>& active,
                  double variance);

// FindSpread for errors that differ from those implied by the weights: (J'J)^-1 J'CJ (J'J)^-1 with
// the covariance C of the residuals in ampere. Only the product of C with rows, one for each
// residual, is needed. Without errors of the local unknowns.
using CovarianceProduct = std::function<RowMatrix(const RowMatrix&)>;
Spread FindSpread(const FitModel& model, const FitPoint& point, const std::vector<bool>& active,
                  const CovarianceProduct& covariance_times);

// Change of the natural parameters by an error of each row: N (J'J)^-1 J' along the directions that
// the data determine, parameters x rows.
struct Linearization;
RowMatrix InfluenceOf(const Linearization& now);

// Standard errors `under` other errors of the residuals over a fit's `own`. A parameter without a
// finite ratio gets the largest of the others, at least 1.
std::vector<double> StretchOf(const std::vector<double>& under, const std::vector<double>& own);

}  // namespace lyrefit
