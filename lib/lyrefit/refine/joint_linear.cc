#include "lyrefit/refine/joint_linear.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace lyrefit {
namespace {

constexpr double kSingular = 1e-12;

// Own unknowns of a curve in the order of its columns.
std::vector<double> Packed(const JointShape& shape, const JointLocal& local) {
  std::vector<double> packed;
  if (shape.irradiance) packed.push_back(local[0]);
  if (shape.temperature) packed.push_back(local[1]);
  return packed;
}

Eigen::MatrixXd NaturalSlope(const JointProblem& problem, const JointCoordinates& coordinates) {
  using Jet = ceres::Jet<double, 18>;
  const std::vector<double> theta = coordinates.Start();
  std::vector<Jet> x(theta.size());
  for (std::size_t k = 0; k < theta.size(); ++k) x[k] = Jet(theta[k], static_cast<int>(k));
  std::vector<Jet> shared(problem.shared());
  coordinates.ToShared(x.data(), shared.data());
  Eigen::MatrixXd slope(problem.shared(), coordinates.size());
  for (int i = 0; i < problem.shared(); ++i) slope.row(i) = shared[i].v.head(coordinates.size());
  return slope;
}

// The shared columns without what the curves' own unknowns can take over.
RowMatrix ProjectOut(const JointLinear& now) {
  RowMatrix projected = now.shared;
  for (std::size_t c = 0; c < now.local.size(); ++c) {
    if (now.local[c].cols() == 0) continue;
    auto block = projected.middleRows(now.first_row[c], now.local[c].rows());
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(now.local[c]);
    const Eigen::MatrixXd taken = qr.solve(Eigen::MatrixXd(block));
    block -= now.local[c] * taken;
  }
  return projected;
}

// Standard errors of the curves' own unknowns, and how many of them their data decide.
void FindLocalErrors(const JointProblem& problem, const JointLinear& now,
                     const Eigen::MatrixXd& coordinate_covariance, double variance,
                     JointSpread* spread) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t c = 0; c < now.local.size(); ++c) {
    JointLocal error = {nan, nan};
    const RowMatrix& local = now.local[c];
    if (local.cols() > 0) {
      const auto block = now.shared.middleRows(now.first_row[c], local.rows());
      const Eigen::MatrixXd inverse = (local.transpose() * local).inverse();
      const Eigen::MatrixXd taken = inverse * local.transpose() * block;
      const Eigen::MatrixXd covariance =
          variance * inverse + taken * coordinate_covariance * taken.transpose();
      const JointCurve& curve = problem.curves[c];
      const JointShape shape = ShapeOf(curve);
      int column = 0;
      const double sds[] = {curve.irradiance_sd, curve.temperature_sd_K};
      for (int which = 0; which < 2; ++which) {
        if (!(which == 0 ? shape.irradiance : shape.temperature)) continue;
        const double own = covariance(column, column);
        error[which] = std::sqrt(own);
        const double prior = sds[which] * sds[which];
        spread->local_degrees += std::isfinite(prior) ? std::max(0.0, 1 - own / prior) : 1;
        ++column;
      }
    }
    spread->local_error.push_back(error);
  }
}

}  // namespace

JointLinear LinearizeJointly(const JointProblem& problem, const JointPoint& point,
                             const std::vector<bool>& held) {
  const JointCoordinates coordinates(problem, point.shared, held);
  const std::vector<double> theta = coordinates.Start();
  JointLinear now;
  int rows = 0;
  for (const JointCurve& curve : problem.curves) {
    now.first_row.push_back(rows);
    rows += ShapeOf(curve).residuals;
  }
  now.residual.setZero(rows);
  now.shared.setZero(rows, coordinates.size());
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const JointShape shape = ShapeOf(problem.curves[c]);
    const std::vector<double> local = Packed(shape, point.local[c]);
    RowMatrix shared, own;
    EvaluateJointCurve(problem, coordinates, static_cast<int>(c), theta.data(), local.data(), 1.0,
                       now.residual.data() + now.first_row[c], &shared, &own);
    now.shared.middleRows(now.first_row[c], shape.residuals) = shared;
    now.local.push_back(own);
  }
  for (int k = 0; k < coordinates.size(); ++k) now.parameter.push_back(coordinates.parameter(k));
  now.natural_slope = NaturalSlope(problem, coordinates);
  return now;
}

JointSpread FindJointSpread(const JointProblem& problem, const JointEnd& end, double variance) {
  const int count = problem.shared();
  JointSpread spread;
  spread.standard_error.assign(count, std::numeric_limits<double>::quiet_NaN());
  spread.correlation = Eigen::MatrixXd::Zero(count, count);
  spread.covariance = Eigen::MatrixXd::Zero(count, count);
  const JointLinear now = LinearizeJointly(problem, end.point, end.held);
  const int moving = static_cast<int>(now.shared.cols());
  const RowMatrix projected = ProjectOut(now);
  const Eigen::VectorXd lengths = projected.colwise().norm();
  Eigen::MatrixXd coordinate_covariance = Eigen::MatrixXd::Zero(moving, moving);
  if (moving > 0 && lengths.allFinite() && lengths.minCoeff() > 0) {
    const Eigen::MatrixXd scaled = projected * lengths.cwiseInverse().asDiagonal();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
    const Eigen::MatrixXd triangle =
        qr.matrixR().topRows(moving).template triangularView<Eigen::Upper>();
    const Eigen::MatrixXd square = triangle * qr.colsPermutation().transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(square, Eigen::ComputeFullV);
    const Eigen::VectorXd& singular = svd.singularValues();
    spread.condition = singular[0] / singular[moving - 1];
    if (singular[moving - 1] > kSingular * singular[0]) {
      const Eigen::MatrixXd half = lengths.cwiseInverse().asDiagonal() * svd.matrixV() *
                                   singular.cwiseInverse().asDiagonal();
      coordinate_covariance = variance * half * half.transpose();
      const Eigen::MatrixXd natural = now.natural_slope * half;
      spread.covariance = variance * natural * natural.transpose();
      for (const int i : now.parameter) {
        spread.standard_error[i] = std::sqrt(spread.covariance(i, i));
        for (const int j : now.parameter) {
          const double norm = natural.row(i).norm() * natural.row(j).norm();
          if (norm > 0) spread.correlation(i, j) = natural.row(i).dot(natural.row(j)) / norm;
        }
      }
    }
  }
  FindLocalErrors(problem, now, coordinate_covariance, variance, &spread);
  return spread;
}

}  // namespace lyrefit
