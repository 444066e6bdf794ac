#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/family/family_judge.h"

namespace lyrefit {

// Factors of the sizes in the unit of the residuals, curves below each other.
struct FamilyErrorShape {
  ErrorShape readings;     // each curve has its own chain, numbered from 0
  RowMatrix common;        // two columns: by irradiance (relative) and by temperature
  std::vector<int> first;  // first row of each curve, then the number of rows
};

// The sizes that maximise the likelihood of the residuals times weak priors. Not the restricted
// likelihood: where a translation model does not fit its curves, other parameters that suit the
// curves' shapes put their temperatures wrong by ten kelvin. Sizes that `kind` does not have are 0.
// `isc_A` and `voc_V` are typical of the curves.
FamilyErrorSizes FindFamilyErrors(FamilyErrorKind kind, const FamilyErrorShape& shape, double isc_A,
                                  double voc_V, const Eigen::VectorXd& residual);

// ln of the likelihood up to a constant.
double LogLikelihood(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                     const Eigen::VectorXd& residual);

// The covariance times rows, one for each residual.
RowMatrix CovarianceTimes(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                          const RowMatrix& rows);

// Finds the errors of the readings and the intervals under correlated errors. The joint fit is a
// least-squares fit, but points of one curve share the path error of the irradiance during the
// sweep and the errors of the curve's stated irradiance and temperature. The kind of errors, and
// the power of the irradiance with which the path error grows, are selected by likelihood. The
// likelihood is that of curves that were not fitted (`rest`, at the joint parameters) if there are
// at least three. Otherwise each half of the curves is tested with the error sizes of the other
// half; fewer than six curves are tested with their own sizes. A richer kind must be clearly
// better.
//
// `judged` has the results of JudgeFamily.
FamilyErrorIntervals FindFamilyIntervals(const ReportedFit& fit, const JointProblem& rest,
                                         const JudgedEnd& judged);

}  // namespace lyrefit
