#include "lyrefit/estimate/refine/spread.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {
namespace {

constexpr double kSingular = 1e-13;
constexpr double kTakenOver = 1e-10;  // of a column's length; a shorter rest is rounding
constexpr double kOpen = 1e-6;        // of a gradient along an undetermined direction

// The columns with the projection on the local unknowns' columns removed.
RowMatrix ProjectOut(const Linearization& now) {
  RowMatrix projected = now.jacobian;
  for (std::size_t c = 0; c < now.local.size(); ++c) {
    if (now.local[c].cols() == 0) continue;
    auto block = projected.middleRows(now.first_row[c], now.local[c].rows());
    const Eigen::MatrixXd taken = LeastSquares(now.local[c], Eigen::MatrixXd(block));
    block -= Times(now.local[c], taken);
  }
  return projected;
}

// Inverse of J'J over the coordinates in two factors. `half` has one column for every direction
// determined by the data (inverse = half half'). `open` has one of length 1 for every direction
// along which no residual changes.
struct Directions {
  Eigen::MatrixXd half;
  Eigen::MatrixXd open;
  double condition = 1;
};

Directions FindDirections(const Linearization& now) {
  const RowMatrix projected = ProjectOut(now);
  const int moving = static_cast<int>(projected.cols());
  Directions found;
  found.half.setZero(moving, 0);
  found.open.setZero(moving, 0);
  // Columns without influence would spoil the scale of the others: each is an open direction.
  std::vector<int> seen;
  const auto add_open = [&](const Eigen::VectorXd& direction) {
    found.open.conservativeResize(Eigen::NoChange, found.open.cols() + 1);
    found.open.rightCols(1) = direction.normalized();
  };
  for (int k = 0; k < moving; ++k) {
    const double length = projected.col(k).norm();
    const bool visible = length > kTakenOver * now.jacobian.col(k).norm() && std::isfinite(length);
    if (visible) seen.push_back(k);
    if (!visible) add_open(Eigen::VectorXd::Unit(moving, k));
  }
  const int count = static_cast<int>(seen.size());
  if (count == 0) return found;
  // Coordinates as functions of the scaled ones.
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

// Whether a linear function of the coordinates is constant along every open direction.
bool Decided(const Eigen::VectorXd& gradient, const Directions& found) {
  for (Eigen::Index k = 0; k < found.open.cols(); ++k) {
    if (std::fabs(gradient.dot(found.open.col(k))) > kOpen * gradient.norm()) return false;
  }
  return true;
}

// Standard errors of the blocks' own unknowns.
std::vector<double> FindLocalErrors(const Linearization& now, const Directions& found,
                                    double variance) {
  std::vector<double> errors;
  for (std::size_t b = 0; b < now.local.size(); ++b) {
    const RowMatrix& local = now.local[b];
    if (local.cols() == 0) continue;
    Eigen::MatrixXd solve = Eigen::MatrixXd::Zero(local.cols(), local.rows());
    const bool full = PseudoInverse(local, &solve);
    const RowMatrix shared = now.jacobian.middleRows(now.first_row[b], local.rows());
    const Eigen::MatrixXd taken = Times(solve, shared);
    const Eigen::MatrixXd through = Times(taken, found.half);
    const Eigen::MatrixXd covariance =
        variance * (TimesTransposed(solve) + TimesTransposed(through));
    for (Eigen::Index k = 0; k < local.cols(); ++k) {
      const bool decided = full && Decided(taken.row(k).transpose(), found);
      errors.push_back(decided ? std::sqrt(covariance(k, k)) : kUnknown);
    }
  }
  return errors;
}

Spread SpreadOf(const Linearization& now, const Directions& found, int count, double variance) {
  Spread spread;
  spread.standard_error.assign(count, kUnknown);
  spread.correlation = Eigen::MatrixXd::Zero(count, count);
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
  return spread;
}

}  // namespace

Spread FindSpread(const FitModel& model, const FitPoint& point, const std::vector<bool>& active,
                  double variance) {
  const Linearization now = Linearize(model, point, active);
  const Directions found = FindDirections(now);
  Spread spread = SpreadOf(now, found, model.shape().size(), variance);
  spread.local_error = FindLocalErrors(now, found, variance);
  return spread;
}

Spread FindSpread(const FitModel& model, const FitPoint& point, const std::vector<bool>& active,
                  const CovarianceProduct& covariance_times) {
  const Linearization now = Linearize(model, point, active);
  Directions found = FindDirections(now);
  const RowMatrix taken = Times(ProjectOut(now), found.half);
  const Eigen::MatrixXd shared =
      TransposedTimes(Eigen::MatrixXd(taken), Eigen::MatrixXd(covariance_times(taken)));
  found.half = Times(found.half, LowerRoot(shared));
  return SpreadOf(now, found, model.shape().size(), 1);
}

RowMatrix InfluenceOf(const Linearization& now) {
  const Directions found = FindDirections(now);
  const RowMatrix taken = Times(ProjectOut(now), found.half);
  return Times(Times(now.natural_slope, found.half), Eigen::MatrixXd(taken.transpose()));
}

std::vector<double> StretchOf(const std::vector<double>& under, const std::vector<double>& own) {
  std::vector<double> stretch;
  double largest = 1;
  for (std::size_t i = 0; i < under.size(); ++i) {
    stretch.push_back(under[i] / own[i]);
    if (std::isfinite(stretch[i])) largest = std::max(largest, stretch[i]);
  }
  for (double& ratio : stretch) ratio = std::isfinite(ratio) ? ratio : largest;
  return stretch;
}

}  // namespace lyrefit
