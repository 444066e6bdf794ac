#include "lyrefit/refine/jacobian.h"

#include <ceres/dynamic_autodiff_cost_function.h>
#include <glog/logging.h>

#include "lyrefit/refine/residuals.h"

namespace lyrefit {

Linearization Linearize(const RefineProblem& problem, const std::vector<double>& p,
                        const std::vector<bool>& held) {
  const Coordinates coordinates(problem, p, held);
  const int moving = coordinates.size();
  const int points = static_cast<int>(problem.voltage_V.size());
  Linearization result;
  result.residual.resize(points);
  result.jacobian.resize(points, moving);
  result.parameter_slope = Eigen::MatrixXd::Zero(problem.device.size(), moving);
  for (int k = 0; k < moving; ++k) result.parameter.push_back(coordinates.parameter(k));

  using Jet = ceres::Jet<double, kJetWidth>;
  CHECK_LE(moving, kJetWidth);
  const std::vector<double> theta = coordinates.Start();
  std::vector<Jet> jets(theta.size());
  for (int k = 0; k < moving; ++k) jets[k] = Jet(theta[k], k);
  const CurveResiduals residuals(problem, coordinates, 1.0);
  std::vector<Jet> r(points);
  const Jet* blocks[] = {jets.data()};
  residuals(blocks, r.data());
  std::vector<Jet> q(problem.device.size());
  coordinates.ToParameters(jets.data(), q.data());
  for (int i = 0; i < points; ++i) {
    result.residual[i] = r[i].a;
    result.jacobian.row(i) = r[i].v.head(moving);
  }
  for (int i = 0; i < problem.device.size(); ++i) {
    if (!held[i] || Coordinates::IsSaturation(i)) {
      result.parameter_slope.row(i) = q[i].v.head(moving);
    }
  }
  return result;
}

}  // namespace lyrefit
