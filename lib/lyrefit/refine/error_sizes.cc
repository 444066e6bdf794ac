#include "lyrefit/refine/error_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lyrefit {
namespace {

// Of more readings, so many evenly spaced ones say where to begin.
constexpr int kManyReadings = 4096;
constexpr int kStartReadings = 1024;

using Logs = std::array<double, 3>;  // ln of current_A, voltage_V, path

Logs LogsOf(const ErrorSizes& sizes) {
  return {std::log(sizes.current_A), std::log(sizes.voltage_V), std::log(sizes.path)};
}

ErrorSizes SizesAt(const Logs& at) { return {std::exp(at[0]), std::exp(at[1]), std::exp(at[2])}; }

// The same problem on every n-th reading.
struct Rows {
  ErrorShape shape;
  RowMatrix columns;  // orthonormal ones for what was fitted, then the residual
};

Rows EveryNth(const Rows& all, int n) {
  Rows few;
  const int count = (static_cast<int>(all.columns.rows()) + n - 1) / n;
  few.columns.resize(count, all.columns.cols());
  for (int k = 0; k < count; ++k) few.columns.row(k) = all.columns.row(k * n);
  const auto thin = [&](const auto& from, auto* to) {
    for (std::size_t k = 0; k < from.size(); k += n) to->push_back(from[k]);
  };
  thin(all.shape.current, &few.shape.current);
  thin(all.shape.voltage, &few.shape.voltage);
  thin(all.shape.path, &few.shape.path);
  thin(all.shape.position, &few.shape.position);
  thin(all.shape.chain, &few.shape.chain);
  thin(all.shape.stated, &few.shape.stated);
  return few;
}

// ln of the restricted likelihood up to a constant. As RestrictedLogLikelihood, of columns that are
// nearly orthogonal: their products say it.
double LogLikelihood(const ErrorModel& errors, const RowMatrix& columns) {
  RowMatrix rows = columns;
  double logs = Whiten(errors, {}, rows);
  const int count = static_cast<int>(rows.cols());
  Eigen::MatrixXd products = TransposedTimes(Eigen::MatrixXd(rows), Eigen::MatrixXd(rows));
  for (int i = 0; i + 1 < count; ++i) {  // Cholesky's decomposition; the last pivot is the rest
    const double pivot = products(i, i);
    if (!(pivot > 0)) return -HUGE_VAL;
    logs += std::log(pivot);
    for (int j = i + 1; j < count; ++j) {
      const double part = products(j, i) / pivot;
      for (int k = i + 1; k <= j; ++k) products(j, k) -= part * products(k, i);
    }
  }
  return -0.5 * (logs + std::max(products(count - 1, count - 1), 0.0));
}

double LogPosterior(const Rows& rows, const ErrorPrior& prior, const Logs& at) {
  const Logs center = LogsOf(prior.center);
  const double width[] = {prior.width.current_A, prior.width.voltage_V, prior.width.path};
  double sum = LogLikelihood(MakeErrorModel(rows.shape, SizesAt(at)), rows.columns);
  for (int i = 0; i < 3; ++i) sum -= 0.5 * std::pow((at[i] - center[i]) / width[i], 2);
  return std::isnan(sum) ? -HUGE_VAL : sum;
}

// Value, slope and curvature by differences.
struct Local {
  double value = 0;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(3, 3);
};

Local LookAround(const Rows& rows, const ErrorPrior& prior, const Logs& at) {
  constexpr double kStep = 0.05;
  const auto value = [&](int i, double a, int j, double b) {
    Logs there = at;
    there[i] += a;
    there[j] += b;
    return LogPosterior(rows, prior, there);
  };
  Local local;
  local.value = LogPosterior(rows, prior, at);
  Logs up{}, down{};
  for (int i = 0; i < 3; ++i) {
    up[i] = value(i, kStep, i, 0);
    down[i] = value(i, -kStep, i, 0);
    local.slope[i] = (up[i] - down[i]) / (2 * kStep);
    local.curvature(i, i) = (up[i] - 2 * local.value + down[i]) / (kStep * kStep);
    for (int j = 0; j < i; ++j) {
      const double both = value(i, kStep, j, kStep);
      const double mixed = (both - up[i] - up[j] + local.value) / (kStep * kStep);
      local.curvature(i, j) = local.curvature(j, i) = mixed;
    }
  }
  return local;
}

// Newton's steps uphill, shortened until they lead there.
Logs Climb(const Rows& rows, const ErrorPrior& prior, Logs at, int most) {
  constexpr double kLongest = 2;     // of a step, in a logarithm
  constexpr double kSettled = 3e-3;  // the same
  for (int step = 0; step < most; ++step) {
    const Local local = LookAround(rows, prior, at);
    bool moved = false;
    double length = 0;
    for (double damping = 0; damping < 1e6 && !moved; damping = std::max(4 * damping, 0.1)) {
      Eigen::VectorXd way;
      const Eigen::MatrixXd damped = damping * Eigen::MatrixXd::Identity(3, 3) - local.curvature;
      if (!SolvePositive(damped, local.slope, &way)) continue;
      length = way.cwiseAbs().maxCoeff();
      if (length > kLongest) way *= kLongest / length;
      Logs there = at;
      for (int i = 0; i < 3; ++i) there[i] += way[i];
      moved = LogPosterior(rows, prior, there) >= local.value;
      if (moved) at = there;
    }
    if (!moved || length < kSettled) break;
  }
  return at;
}

// The best of a coarse grid about the prior and about what the residuals measure.
Logs FindStart(const Rows& rows, const ErrorPrior& prior) {
  const Eigen::VectorXd residual = rows.columns.rightCols(1);
  double typical = 0;
  for (const double one : rows.shape.current) typical += one * one;
  const double rms_A =
      std::max(residual.norm() / std::sqrt(typical), 1e-12 * prior.center.current_A);
  const Logs usual = LogsOf(prior.center);
  const double relative = rms_A / prior.center.current_A * prior.width.path;
  Logs best{};
  double highest = -HUGE_VAL;
  for (const double current : {1.0, 0.2}) {
    for (const double voltage : {0.03, 1.0}) {
      for (const double path : {0.05, 0.5, 2.0}) {
        const Logs at = {std::log(current * rms_A), usual[1] + std::log(voltage),
                         usual[2] + std::log(path * std::min(std::max(relative, 1e-3), 10.0))};
        const double value = LogPosterior(rows, prior, at);
        if (!(value > highest)) continue;
        highest = value;
        best = at;
      }
    }
  }
  return highest > -HUGE_VAL ? best : usual;
}

// The same of errors that know nothing of each other, at the size that suits them best.
double WhiteLogLikelihood(const Rows& rows) {
  ErrorModel white;
  white.white = rows.shape.stated.empty() ? rows.shape.current : rows.shape.stated;
  RowMatrix unit = rows.columns;
  Whiten(white, {}, unit);
  const Eigen::MatrixXd slopes = unit.leftCols(unit.cols() - 1);
  const double degrees = static_cast<double>(slopes.rows() - slopes.cols());
  const double rest = WithoutColumns(slopes, Eigen::VectorXd(unit.rightCols(1))).norm();
  for (double& one : white.white) one *= rest / std::sqrt(degrees);
  return LogLikelihood(white, rows.columns);
}

}  // namespace

bool AreClose(const ErrorSizes& a, const ErrorSizes& b, double tolerance) {
  const auto close = [&](double one, double other) {
    return std::fabs(one - other) <= tolerance * std::fabs(other);
  };
  return close(a.current_A, b.current_A) && close(a.voltage_V, b.voltage_V) &&
         close(a.path, b.path);
}

ErrorModel MakeErrorModel(const ErrorShape& shape, const ErrorSizes& sizes) {
  ErrorModel errors;
  for (std::size_t k = 0; k < shape.current.size(); ++k) {
    const double current =
        shape.stated.empty() ? sizes.current_A * shape.current[k] : shape.stated[k];
    errors.white.push_back(std::hypot(current, sizes.voltage_V * shape.voltage[k]));
    if (sizes.path > 0) errors.path.push_back(sizes.path * shape.path[k]);
  }
  errors.position = shape.position;
  errors.chain = shape.chain;
  return errors;
}

ErrorPrior UsualErrors(double isc_A, double voc_V) {
  return {{3e-4 * isc_A, 3e-4 * voc_V, 1.2e-3}, {3, 3, 1}};
}

FoundErrors FindErrorSizes(const ErrorShape& shape, const ErrorPrior& prior,
                           const Eigen::VectorXd& residual, const RowMatrix& jacobian) {
  const Eigen::MatrixXd basis = RankedBasis(Eigen::MatrixXd(jacobian));
  Rows all{shape, RowMatrix(residual.size(), basis.cols() + 1)};
  all.columns.leftCols(basis.cols()) = basis;
  all.columns.rightCols(1) = residual;
  const int rows = static_cast<int>(residual.size());
  Logs at{};
  if (rows > kManyReadings) {
    const Rows few = EveryNth(all, rows / kStartReadings);
    at = Climb(few, prior, FindStart(few, prior), 20);
    at = Climb(all, prior, at, 3);
  } else {
    at = Climb(all, prior, FindStart(all, prior), 30);
  }
  FoundErrors found;
  found.sizes = SizesAt(at);
  const double likely = LogLikelihood(MakeErrorModel(shape, found.sizes), all.columns);
  found.gain = 2 * (likely - WhiteLogLikelihood(all));
  return found;
}

}  // namespace lyrefit
