#include "lyrefit/refine/sensitivity.h"

#include <cmath>
#include <limits>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/jacobian.h"

namespace lyrefit {

Sensitivity FindSensitivity(const RefineProblem& problem, const RefineEnd& end,
                            int degrees_of_freedom) {
  const int count = problem.device.size();
  Sensitivity result;
  result.standard_error.assign(count, std::numeric_limits<double>::quiet_NaN());
  result.correlation = Eigen::MatrixXd::Zero(count, count);
  const Linearization now = Linearize(problem, end.p, end.held);
  const int moving = static_cast<int>(now.jacobian.cols());
  const Eigen::VectorXd lengths = now.jacobian.colwise().norm();
  if (moving == 0 || !(lengths.minCoeff() > 0) || !lengths.allFinite()) return result;

  const Eigen::MatrixXd scaled = now.jacobian * lengths.cwiseInverse().asDiagonal();
  const RightSingular svd = FindRightSingular(scaled);
  const Eigen::VectorXd& singular = svd.values;
  constexpr double kSingular = 1e-13;
  result.condition = singular[0] / singular[singular.size() - 1];
  if (singular.size() < moving || !(singular[moving - 1] > kSingular * singular[0])) return result;

  const double variance = now.residual.squaredNorm() / degrees_of_freedom;
  // Rows: sensitivity of each natural parameter to the independent directions of the data.
  const Eigen::MatrixXd slope = now.parameter_slope * lengths.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd spread = Times(slope, svd.vectors) * singular.cwiseInverse().asDiagonal();
  const Eigen::VectorXd norm = spread.rowwise().norm();
  for (int i = 0; i < count; ++i) {
    if (end.held[i] || !(norm[i] > 0)) continue;
    result.standard_error[i] = norm[i] * std::sqrt(variance);
    for (int j = 0; j < count; ++j) {
      if (end.held[j] || !(norm[j] > 0)) continue;
      result.correlation(i, j) = spread.row(i).dot(spread.row(j)) / (norm[i] * norm[j]);
    }
  }
  return result;
}

}  // namespace lyrefit
