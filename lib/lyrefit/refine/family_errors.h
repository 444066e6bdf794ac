#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/error_sizes.h"

namespace lyrefit {

// What the sizes multiply, in the unit of the residuals, curves below each other.
struct FamilyErrorShape {
  ErrorShape readings;     // of each curve its own chain, numbered from 0
  RowMatrix common;        // two columns, by irradiance (relative) and temperature
  std::vector<int> first;  // row of each curve, and the end
};

// The sizes at which the likelihood of the residuals, times weak priors, is largest. Not the
// restricted one: where a law misses its curves, it would ask what other parameters might have
// said, and those that suit the curves' shapes put their temperatures wrong by ten kelvin. Sizes
// that `kind` does not have are 0. `isc_A` and `voc_V` are typical of the curves.
FamilyErrorSizes FindFamilyErrors(FamilyErrorKind kind, const FamilyErrorShape& shape, double isc_A,
                                  double voc_V, const Eigen::VectorXd& residual);

// ln of the likelihood up to a constant.
double LogLikelihood(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                     const Eigen::VectorXd& residual);

// The covariance times rows, one for each residual.
RowMatrix CovarianceTimes(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                          const RowMatrix& rows);

}  // namespace lyrefit
