#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/error_model.h"
#include "lyrefit/refine/error_terms.h"

namespace lyrefit {

// What of every reading the sizes multiply, in the unit of the residuals per unit of the size.
struct ErrorShape {
  std::vector<double> current;
  std::vector<double> voltage;
  std::vector<double> path;
  std::vector<double> position;  // as in ErrorModel, but in Voc
  std::vector<int> chain;
  std::vector<double>
      averaged_away;           // the part of path^2 per length of the path, where it is small
  std::vector<double> stated;  // of a current by itself, in the unit of the residuals: believed in
                               // the place of `current`; empty: nobody stated it
};

ErrorModel MakeErrorModel(const ErrorShape& shape, const ErrorSizes& sizes);

// What is believed of the sizes before the residuals are seen: their logarithms are normal about
// those of `center` with these standard deviations.
struct ErrorPrior {
  ErrorSizes center;
  ErrorSizes width;
};

// The prior of a curve of this Isc and Voc. The path: healthy modules depart from the model by 0.98
// to 1.33e-3 of Isc, one by 3.4e-3, clean cells by much less; hence 1.2e-3 and a factor of e either
// way. Its length: one Voc fits those modules best; filters of instruments and short disturbances
// correlate neighbours alone. The readings: a factor of 20 about what tracers have, which is next to
// nothing.
ErrorPrior UsualErrors(double isc_A, double voc_V);

// What residuals say of their errors.
struct FoundErrors {
  // Where restricted likelihood times prior is largest or, of a longer path, nearly so.
  ErrorSizes sizes;
  // Covariance of the logarithms of current, voltage, path and length, from the curvature there; 0
  // where there is no maximum.
  Eigen::Matrix4d uncertainty = Eigen::Matrix4d::Zero();
  // Twice the gain in ln restricted likelihood over errors that know nothing of each other, have
  // the shape of `current` (or `stated`) and the size that suits them best.
  double gain = 0;
};

// Where rows are means of groups of readings: the differences of neighbours within each group,
// which are independent of each other, and nearly so of the means. What each reading has by itself
// shows there.
struct Differences {
  // One for each group, typical of its differences; `position` is the distance of two neighbours,
  // chains are unused.
  ErrorShape shape;
  std::vector<double> count;
  std::vector<double> mean_square;
};

// `residual` and `jacobian`, its derivatives by what was fitted, as in RestrictedLogLikelihood;
// more rows than columns. In proportion to the rows.
FoundErrors FindErrorSizes(const ErrorShape& shape, const ErrorPrior& prior,
                           const Eigen::VectorXd& residual, const RowMatrix& jacobian,
                           const Differences& differences = {});

}  // namespace lyrefit
