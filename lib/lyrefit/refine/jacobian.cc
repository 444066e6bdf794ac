#include "lyrefit/refine/jacobian.h"

#include <ceres/jet.h>
#include <glog/logging.h>

#include "lyrefit/refine/residuals.h"

namespace lyrefit {

Linearization Linearize(const RefineProblem& problem, const std::vector<double>& p,
                        const std::vector<bool>& held) {
  const Coordinates coordinates(problem, p, held);
  const int moving = coordinates.size();
  const int points = static_cast<int>(problem.voltage_V.size());
  Linearization result;
  result.residual = Eigen::VectorXd::Zero(points);
  result.parameter_slope = Eigen::MatrixXd::Zero(problem.device.size(), moving);
  for (int k = 0; k < moving; ++k) result.parameter.push_back(coordinates.parameter(k));

  using Jet = ceres::Jet<double, kJetWidth>;
  CHECK_LE(moving, kJetWidth);
  const std::vector<double> theta = coordinates.Start();
  std::vector<Jet> jets(theta.size());
  for (int k = 0; k < moving; ++k) jets[k] = Jet(theta[k], k);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(points, moving);
  rows.setZero();
  const CurveResiduals residuals(problem, coordinates, 1.0);
  residuals.Evaluate(theta.data(), result.residual.data(), rows.data());
  result.jacobian = rows;
  std::vector<Jet> q(problem.device.size());
  coordinates.ToParameters(jets.data(), q.data());
  for (int i = 0; i < problem.device.size(); ++i) {
    if (!held[i] || Coordinates::IsSaturation(i)) {
      result.parameter_slope.row(i) = q[i].v.head(moving);
    }
  }
  return result;
}

}  // namespace lyrefit
