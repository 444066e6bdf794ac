#include "lyrefit/refine/joint_linear.h"

#include <ceres/jet.h>

#include <cmath>
#include <limits>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

constexpr double kSingular = 1e-12;
constexpr double kTakenOver = 1e-10;  // of a column's length: what is left of it is rounding
constexpr double kOpen = 1e-6;        // of a gradient along a direction that nothing decides

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
    const Eigen::MatrixXd taken = LeastSquares(now.local[c], Eigen::MatrixXd(block));
    block -= Times(now.local[c], taken);
  }
  return projected;
}

// Inverse of J'J over the shared coordinates in two factors: `half` has a column for every
// direction that the data decide (inverse = half half'), `open` one of length 1 for every direction
// along which nothing changes.
struct Directions {
  Eigen::MatrixXd half;
  Eigen::MatrixXd open;
  double condition = 1;
};

Directions FindDirections(const JointLinear& now) {
  const RowMatrix projected = ProjectOut(now);
  const int moving = static_cast<int>(projected.cols());
  Directions found;
  found.half.setZero(moving, 0);
  found.open.setZero(moving, 0);
  // Columns without influence would spoil the scale of the others: they are open by themselves.
  std::vector<int> seen;
  const auto add_open = [&](const Eigen::VectorXd& direction) {
    found.open.conservativeResize(Eigen::NoChange, found.open.cols() + 1);
    found.open.rightCols(1) = direction.normalized();
  };
  for (int k = 0; k < moving; ++k) {
    const double length = projected.col(k).norm();
    const bool visible = length > kTakenOver * now.shared.col(k).norm() && std::isfinite(length);
    if (visible) seen.push_back(k);
    if (!visible) add_open(Eigen::VectorXd::Unit(moving, k));
  }
  const int count = static_cast<int>(seen.size());
  if (count == 0) return found;
  // Coordinates by scaled ones.
  Eigen::MatrixXd unscale = Eigen::MatrixXd::Zero(moving, count);
  for (int k = 0; k < count; ++k) unscale(seen[k], k) = 1 / projected.col(seen[k]).norm();
  const RightSingular svd = FindAllRightSingular(Times(projected, unscale));
  const Eigen::VectorXd& singular = svd.values;
  found.condition = singular[0] / singular[count - 1];
  for (int k = 0; k < count; ++k) {
    const Eigen::VectorXd direction = Times(unscale, Eigen::VectorXd(svd.vectors.col(k)));
    if (!(singular[k] > kSingular * singular[0])) {
      add_open(direction);
      continue;
    }
    found.half.conservativeResize(Eigen::NoChange, found.half.cols() + 1);
    found.half.rightCols(1) = direction / singular[k];
  }
  return found;
}

// Whether a linear function of the coordinates stays the same along every open direction.
bool Decided(const Eigen::VectorXd& gradient, const Directions& found) {
  for (Eigen::Index k = 0; k < found.open.cols(); ++k) {
    if (std::fabs(gradient.dot(found.open.col(k))) > kOpen * gradient.norm()) return false;
  }
  return true;
}

// Standard errors of the curves' own unknowns, and how many of them their data decide.
void FindLocalErrors(const JointProblem& problem, const JointLinear& now, const Directions& found,
                     double variance, JointSpread* spread) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t c = 0; c < now.local.size(); ++c) {
    spread->local_error.push_back({nan, nan});
    const RowMatrix& local = now.local[c];
    if (local.cols() == 0) continue;
    const JointCurve& curve = problem.curves[c];
    const JointShape shape = ShapeOf(curve);
    Eigen::MatrixXd solve = Eigen::MatrixXd::Zero(local.cols(), local.rows());
    const bool full = PseudoInverse(local, &solve);
    const RowMatrix shared = now.shared.middleRows(now.first_row[c], local.rows());
    const Eigen::MatrixXd taken = Times(solve, shared);
    const Eigen::MatrixXd through = Times(taken, found.half);
    const Eigen::MatrixXd covariance =
        variance * (TimesTransposed(solve) + TimesTransposed(through));
    int column = 0;
    const double sds[] = {curve.irradiance_sd, curve.temperature_sd_K};
    for (int which = 0; which < 2; ++which) {
      if (!(which == 0 ? shape.irradiance : shape.temperature)) continue;
      const double own = covariance(column, column);
      const bool decided = full && Decided(taken.row(column).transpose(), found);
      if (decided) spread->local_error[c][which] = std::sqrt(own);
      const double prior = sds[which] * sds[which];
      const bool free = !std::isfinite(prior);
      spread->local_degrees += free ? 1 : decided ? std::max(0.0, 1 - own / prior) : 0;
      ++column;
    }
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
    const std::vector<double> local = PackLocal(shape, point.local[c]);
    RowMatrix shared, own;
    if (!EvaluateJointCurve(problem, coordinates, static_cast<int>(c), theta.data(), local.data(),
                            1.0, now.residual.data() + now.first_row[c], &shared, &own)) {
      // No place to be: no slope either.
      now.residual.segment(now.first_row[c], shape.residuals).setZero();
      now.local.push_back(RowMatrix::Zero(shape.residuals, shape.locals));
      continue;
    }
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
  const JointLinear now = LinearizeJointly(problem, end.point, end.held);
  const Directions found = FindDirections(now);
  spread.condition = found.condition;
  const Eigen::MatrixXd natural = Times(now.natural_slope, found.half);
  spread.covariance = TimesTransposed(natural, variance);
  spread.open = Times(now.natural_slope, found.open);
  std::vector<int> decided;
  for (const int i : now.parameter) {
    if (Decided(now.natural_slope.row(i).transpose(), found)) decided.push_back(i);
  }
  for (const int i : decided) {
    spread.standard_error[i] = std::sqrt(spread.covariance(i, i));
    for (const int j : decided) {
      const double norm = natural.row(i).norm() * natural.row(j).norm();
      if (norm > 0) spread.correlation(i, j) = natural.row(i).dot(natural.row(j)) / norm;
    }
  }
  FindLocalErrors(problem, now, found, variance, &spread);
  return spread;
}

}  // namespace lyrefit
