#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/estimate/refine/error_terms.h"

namespace lyrefit {

// Maximises a smooth function of a few logarithms from `at` by Newton steps, with derivatives by
// differences. Steps are damped until the function rises; at most `most_steps`. The function
// returns -infinity where it is undefined.
std::vector<double> NewtonAscent(const std::function<double(const std::vector<double>&)>& value,
                                 std::vector<double> at, int most_steps);

// The second derivatives of such a function at a point, by differences.
Eigen::MatrixXd CurvatureAt(const std::function<double(const std::vector<double>&)>& value,
                            const std::vector<double>& at);

// Factors of the sizes for every reading, in the unit of the residuals per unit of the size.
struct ErrorShape {
  std::vector<double> current;
  std::vector<double> voltage;
  std::vector<double> path;
  std::vector<double> position;  // as in ErrorModel, but in Voc
  std::vector<int> chain;
  std::vector<double> averaged_away;  // part of path^2 per length of the path, if small
  std::vector<double> stated;         // standard deviation of a stated current error, in the
                                      // unit of the residuals; replaces `current`; empty: none
  std::vector<double> part = {};      // of current_part; empty: no such error
};

ErrorModel MakeErrorModel(const ErrorShape& shape, const ErrorSizes& sizes);

// Error models with a gain (FoundErrors) above this are believed. Independent errors exceed it in
// some 3 % of curves.
constexpr double kGainToBelieve = 5;

// Prior of the sizes: their logarithms are normal about those of `center` with the standard
// deviations `width`.
struct ErrorPrior {
  ErrorSizes center;
  ErrorSizes width;
  // Whether devices of this kind are known to have a path of the prior's size. Otherwise a path that
  // gains less than kGainToBelieve over independent errors of all kinds is 0. A path is at least 0,
  // so one of known length gains that much by chance with 1.3 % (half a chi-square of one degree,
  // Self and Liang 1987, doi:10.1080/01621459.1987.10478472).
  bool path_is_usual = true;
};

// The prior of a curve of this Isc and Voc. Path: healthy modules depart from the model by 0.98 to
// 1.33e-3 of Isc, one by 3.4e-3, clean cells by much less; hence 1.2e-3 and a factor of e either
// way. Length: one Voc fits those modules best; filters of instruments and short disturbances
// correlate only neighbours. Readings: a factor of 20 about those of tracers, a very weak prior.
ErrorPrior UsualErrors(double isc_A, double voc_V);

using ErrorMatrix = Eigen::Matrix<double, 5, 5>;

// Error sizes estimated from residuals.
struct FoundErrors {
  // Maximum of restricted likelihood times prior, or a longer path of nearly the same posterior.
  ErrorSizes sizes;
  // Covariance of the logarithms of current, voltage, path, length and part, from the curvature at
  // the maximum; 0 if there is no maximum, and of sizes that were not sought.
  ErrorMatrix uncertainty = ErrorMatrix::Zero();
  // Twice the gain in ln restricted likelihood over independent errors of the shape of `current`
  // (or `stated`) and their best size.
  double gain = 0;
  // The same of a path over independent errors of all kinds. NaN if a path is usual.
  double path_gain = kUnknown;
};

// For rows that are means of groups of readings: the differences of neighbours within each group.
// They are independent of each other, nearly independent of the means, and show the independent
// errors of the readings.
struct Differences {
  // One for each group, typical of its differences. `position` is the distance of two neighbours;
  // `chain` is unused.
  ErrorShape shape;
  std::vector<double> count;
  std::vector<double> mean_square;
};

// `residual` and `jacobian` (its derivatives by the fitted parameters) as in
// RestrictedLogLikelihood; more rows than columns. Linear in the rows.
FoundErrors FindErrorSizes(const ErrorShape& shape, const ErrorPrior& prior,
                           const Eigen::VectorXd& residual, const RowMatrix& jacobian,
                           const Differences& differences = {});

}  // namespace lyrefit
