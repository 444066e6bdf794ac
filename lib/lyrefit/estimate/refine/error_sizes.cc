#include "lyrefit/estimate/refine/error_sizes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lyrefit {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

struct Surroundings {
  double value = 0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd curvature;
};

Surroundings LookAround(const Function& value, const std::vector<double>& at, double value_there) {
  constexpr double kStep = 0.05;
  const int size = static_cast<int>(at.size());
  const auto beside = [&](int i, double a, int j, double b) {
    std::vector<double> there = at;
    there[i] += a;
    there[j] += b;
    return value(there);
  };
  Surroundings found;
  found.value = value_there;
  found.slope.resize(size);
  found.curvature.resize(size, size);
  std::vector<double> up(size);
  for (int i = 0; i < size; ++i) {
    up[i] = beside(i, kStep, i, 0);
    const double down = beside(i, -kStep, i, 0);
    found.slope[i] = (up[i] - down) / (2 * kStep);
    found.curvature(i, i) = (up[i] - 2 * found.value + down) / (kStep * kStep);
    for (int j = 0; j < i; ++j) {
      const double both = beside(i, kStep, j, kStep);
      const double mixed = (both - up[i] - up[j] + found.value) / (kStep * kStep);
      found.curvature(i, j) = found.curvature(j, i) = mixed;
    }
  }
  return found;
}

}  // namespace

Eigen::MatrixXd CurvatureAt(const Function& value, const std::vector<double>& at) {
  return LookAround(value, at, value(at)).curvature;
}

std::vector<double> NewtonAscent(const Function& value, std::vector<double> at, int most_steps) {
  constexpr double kLongest = 2;     // step in any one coordinate
  constexpr double kSettled = 3e-3;  // step in any one coordinate at convergence
  const auto size = static_cast<Eigen::Index>(at.size());
  double value_there = value(at);
  for (int step = 0; step < most_steps; ++step) {
    const Surroundings here = LookAround(value, at, value_there);
    bool moved = false;
    double length = 0;
    for (double damping = 0; damping < 1e6 && !moved; damping = std::max(4 * damping, 0.1)) {
      Eigen::VectorXd way;
      const Eigen::MatrixXd damped =
          damping * Eigen::MatrixXd::Identity(size, size) - here.curvature;
      if (!SolvePositive(damped, here.slope, &way)) continue;
      length = way.cwiseAbs().maxCoeff();
      if (length > kLongest) way *= kLongest / length;
      std::vector<double> there = at;
      for (Eigen::Index i = 0; i < size; ++i) there[i] += way[i];
      value_there = value(there);
      moved = value_there >= here.value;
      if (moved) at = std::move(there);
    }
    if (!moved || length < kSettled) break;
  }
  return at;
}

namespace {

// Standard deviation of the prior of ln length below its center, and above it. A path longer than
// the center hardly changes within the sweep: only one combination of its size and length is
// identifiable.
constexpr double kLengthWidth = 8;
constexpr double kLongerWidth = 0.5;

// ln of current_A, voltage_V and, with a path, path, length, else current_part where it has a shape.
using Logs = std::vector<double>;

Logs LogsOf(const ErrorSizes& sizes) {
  return {std::log(sizes.current_A), std::log(sizes.voltage_V), std::log(sizes.path),
          std::log(sizes.length)};
}

ErrorSizes SizesAt(const Logs& at) {
  const double part = at.size() == 3 ? std::exp(at[2]) : 0;
  if (at.size() < 4) return {std::exp(at[0]), std::exp(at[1]), 0, 1, part};
  return {std::exp(at[0]), std::exp(at[1]), std::exp(at[2]), std::exp(at[3])};
}

struct Rows {
  const ErrorShape& shape;
  RowMatrix columns;  // orthonormal basis of the fitted directions, then the residual
  const Differences& differences;
};

// 1 less the mean of exp(-|x - x'|) over a stretch of three times `third`: the part of the path's
// variance that averaging removes.
double AveragedAway(double third) {
  const double x = 3 * third;
  if (x < 1e-3) return third;
  return 1 - 2 * (x + std::expm1(-x)) / (x * x);
}

// Sum of the logarithms of many factors, with one logarithm for many of them.
class LogSum {
 public:
  void Add(double factor) {
    product_ *= factor;
    if (product_ > 1e-200 && product_ < 1e200) return;
    sum_ += std::log(product_);
    product_ = 1;
  }
  double Total() const { return sum_ + std::log(product_); }

 private:
  double sum_ = 0;
  double product_ = 1;
};

// Restricted log-likelihood from ln det of the covariance and the lower triangle of the Gram matrix
// of the whitened columns, the residual last. The columns must be nearly orthogonal.
double RestrictedFromProducts(double* products, int columns, LogSum log_determinant) {
  const int last = columns - 1;
  const auto at = [&](int i, int j) -> double& { return products[i * columns + j]; };
  for (int i = 0; i < last; ++i) {  // Cholesky; the last pivot is the residual sum
    const double pivot = at(i, i);
    if (!(pivot > 0)) return -HUGE_VAL;
    log_determinant.Add(pivot);
    for (int j = i + 1; j <= last; ++j) {
      const double part = at(j, i) / pivot;
      for (int k = i + 1; k <= j; ++k) at(j, k) -= part * at(k, i);
    }
  }
  return -0.5 * (log_determinant.Total() + std::max(at(last, last), 0.0));
}

// The restricted log-likelihood of MakeErrorModel(shape, sizes). The readings are whitened one after
// the other, then multiplied column by column.
double LogLikelihood(const ErrorShape& shape, const ErrorSizes& sizes, const RowMatrix& rows) {
  const int columns = static_cast<int>(rows.cols());
  std::vector<double> buffer(columns * (2 + columns), 0.0);
  double* const state = buffer.data();  // prediction of the path
  double* const white = state + columns;
  double* const products = white + columns;
  Eigen::MatrixXd whitened(rows.rows(), columns);
  const double per_length = 1 / sizes.length;
  PathFilter filter;
  LogSum logs;
  for (std::size_t k = 0; k < shape.current.size(); ++k) {
    const double current =
        shape.stated.empty() ? sizes.current_A * shape.current[k] : shape.stated[k];
    const double voltage = sizes.voltage_V * shape.voltage[k];
    const double part = shape.part.empty() ? 0 : sizes.current_part * shape.part[k];
    const double path = sizes.path * shape.path[k];
    double own = current * current + voltage * voltage + part * part;
    if (!shape.averaged_away.empty() && shape.averaged_away[k] > 0) {
      own -= path * path * AveragedAway(shape.averaged_away[k] * per_length);
    }
    const bool follows = k > 0 && shape.chain[k - 1] == shape.chain[k];
    const double kept =
        follows ? std::exp((shape.position[k - 1] - shape.position[k]) * per_length) : 0.0;
    const FilterStep step = filter.Next(own, path, kept);
    logs.Add(step.total);
    step.Whiten(columns, rows.data() + k * columns, state, white);
    for (int i = 0; i < columns; ++i) whitened(static_cast<Eigen::Index>(k), i) = white[i];
  }
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j <= i; ++j) products[i * columns + j] = whitened.col(i).dot(whitened.col(j));
  }
  return RestrictedFromProducts(products, columns, logs);
}

double LogLikelihood(const Differences& differences, const ErrorSizes& sizes) {
  const ErrorModel errors = MakeErrorModel(differences.shape, sizes);
  double sum = 0;
  for (int g = 0; g < errors.size(); ++g) {
    const double path = errors.path.empty() ? 0 : errors.path[g];
    const double parted = -std::expm1(-errors.position[g]);
    const double variance = errors.white[g] * errors.white[g] + path * path * parted;
    const double terms = std::log(variance) + differences.mean_square[g] / variance;
    sum -= 0.5 * differences.count[g] * terms;
  }
  return sum;
}

double LogPosterior(const Rows& rows, const ErrorPrior& prior, const Logs& at) {
  const bool path = at.size() == 4;
  Logs center = LogsOf(prior.center);
  if (!path) center[2] = std::log(prior.center.current_part);
  const double width[] = {prior.width.current_A, prior.width.voltage_V,
                          path ? prior.width.path : prior.width.current_part, prior.width.length};
  const ErrorSizes sizes = SizesAt(at);
  double sum =
      LogLikelihood(rows.shape, sizes, rows.columns) + LogLikelihood(rows.differences, sizes);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const bool longer = i == 3 && at[i] > center[i];
    sum -= 0.5 * std::pow((at[i] - center[i]) / (longer ? kLongerWidth : width[i]), 2);
  }
  return std::isnan(sum) ? -HUGE_VAL : sum;
}

// The best point of a coarse grid about the prior and about the size of the residuals.
Logs FindStart(const Rows& rows, const ErrorPrior& prior) {
  const Eigen::VectorXd residual = rows.columns.rightCols(1);
  double typical = 0;
  for (const double one : rows.shape.current) typical += one * one;
  const double rms_A =
      std::max(residual.norm() / std::sqrt(typical), 1e-12 * prior.center.current_A);
  const Logs usual = LogsOf(prior.center);
  const double relative = rms_A / prior.center.current_A * prior.width.path;
  Logs best;
  double highest = -HUGE_VAL;
  const auto consider = [&](double current, double voltage, double path, double length) {
    const Logs at = {std::log(current * rms_A), usual[1] + std::log(voltage),
                     usual[2] + std::log(path * std::min(std::max(relative, 1e-3), 10.0)),
                     usual[3] + std::log(length)};
    const double value = LogPosterior(rows, prior, at);
    if (!(value > highest)) return;
    highest = value;
    best = at;
  };
  for (const double current : {1.0, 0.2}) {
    for (const double voltage : {0.03, 1.0}) {
      for (const double path : {0.05, 0.5, 2.0}) {
        for (const double length : {1.0, 0.2, 0.04}) consider(current, voltage, path, length);
      }
    }
  }
  return highest > -HUGE_VAL ? best : usual;
}

// Of the sizes that are sought; 0 for the others, and if the matrix is not positive definite.
ErrorMatrix InverseOf(const Eigen::MatrixXd& curvature) {
  constexpr int kPart = 4;
  const Eigen::Index size = curvature.rows();
  const auto place = [size](Eigen::Index i) { return size == 3 && i == 2 ? kPart : i; };
  ErrorMatrix inverse = ErrorMatrix::Zero();
  for (Eigen::Index j = 0; j < size; ++j) {
    Eigen::VectorXd column;
    if (!SolvePositive(curvature, Eigen::VectorXd::Unit(size, j), &column)) {
      return ErrorMatrix::Zero();
    }
    for (Eigen::Index i = 0; i < size; ++i) inverse(place(i), place(j)) = column[i];
  }
  return inverse;
}

// LogLikelihood of independent errors of the best size.
double WhiteLogLikelihood(const Rows& rows) {
  ErrorShape independent = rows.shape;
  if (!independent.stated.empty()) independent.current = std::move(independent.stated);
  independent.stated.clear();
  RowMatrix unit = rows.columns;
  for (Eigen::Index k = 0; k < unit.rows(); ++k) unit.row(k) /= independent.current[k];
  const Eigen::MatrixXd slopes = unit.leftCols(unit.cols() - 1);
  const double degrees = static_cast<double>(slopes.rows() - slopes.cols());
  const double rest = WithoutColumns(slopes, Eigen::VectorXd(unit.rightCols(1))).norm();
  return LogLikelihood(independent, {rest / std::sqrt(degrees), 0, 0, 1}, rows.columns);
}

// The longest path, up to the prior's length, of nearly the posterior of the maximum `top`. A fit
// absorbs the slowest part of the path from the residuals, so the data hardly bound its length from
// above. Too short a path makes standard errors too small.
Logs LongestAllowed(const std::function<double(const Logs&)>& value, const Logs& top,
                    double usual) {
  constexpr double kAllowed = 0.25;  // loss in ln posterior
  constexpr int kLonger = 4, kMostSteps = 10;
  const double highest = value(top);
  Logs at = top, longest = top;
  for (int step = 1; step <= kLonger && top[3] < usual; ++step) {
    const double length = top[3] + (usual - top[3]) * step / kLonger;
    const auto others = [&](const Logs& three) {
      return value({three[0], three[1], three[2], length});
    };
    // The differences of neighbours, path^2 / length, stay constant.
    const double path = at[2] + 0.5 * (length - at[3]);
    at = NewtonAscent(others, {at[0], at[1], path}, kMostSteps);
    at.push_back(length);
    if (value(at) >= highest - kAllowed) longest = at;
  }
  return longest;
}

// The best sizes of independent errors: the higher of two ascents, with an error in proportion to the
// current that is large or small.
Logs BestIndependent(const Rows& rows, const ErrorPrior& prior, const Logs& top) {
  constexpr int kMostSteps = 30;
  const auto value = [&](const Logs& there) { return LogPosterior(rows, prior, there); };
  if (rows.shape.part.empty()) return NewtonAscent(value, {top[0], top[1]}, kMostSteps);
  const double usual = std::log(prior.center.current_part);
  const Logs small = NewtonAscent(value, {top[0], top[1], usual - 2}, kMostSteps);
  const Logs large = NewtonAscent(
      value, {top[0] - 1, top[1], top[0] - std::log(prior.center.current_A) + usual}, kMostSteps);
  return value(large) > value(small) ? large : small;
}

}  // namespace

bool AreClose(const ErrorSizes& a, const ErrorSizes& b, double tolerance) {
  const auto close = [&](double one, double other) {
    return std::fabs(one - other) <= tolerance * std::fabs(other);
  };
  return close(a.current_A, b.current_A) && close(a.voltage_V, b.voltage_V) &&
         close(a.path, b.path) && close(a.length, b.length) &&
         close(a.current_part, b.current_part);
}

ErrorModel MakeErrorModel(const ErrorShape& shape, const ErrorSizes& sizes) {
  ErrorModel errors;
  errors.white.reserve(shape.current.size());
  if (sizes.path > 0) errors.path.reserve(shape.current.size());
  for (std::size_t k = 0; k < shape.current.size(); ++k) {
    const double current =
        shape.stated.empty() ? sizes.current_A * shape.current[k] : shape.stated[k];
    const double part = shape.part.empty() ? 0 : sizes.current_part * shape.part[k];
    errors.white.push_back(std::hypot(current, sizes.voltage_V * shape.voltage[k], part));
    if (sizes.path > 0) errors.path.push_back(sizes.path * shape.path[k]);
  }
  for (const double position : shape.position) errors.position.push_back(position / sizes.length);
  errors.chain = shape.chain;
  for (const double part : shape.averaged_away) {
    errors.averaged_away.push_back(AveragedAway(part / sizes.length));
  }
  return errors;
}

ErrorPrior UsualErrors(double isc_A, double voc_V) {
  return {{3e-4 * isc_A, 3e-4 * voc_V, 1.2e-3, 1, 3e-4}, {3, 3, 1, kLengthWidth, 3}};
}

FoundErrors FindErrorSizes(const ErrorShape& shape, const ErrorPrior& prior,
                           const Eigen::VectorXd& residual, const RowMatrix& jacobian,
                           const Differences& differences) {
  const Eigen::MatrixXd basis = RankedBasis(Eigen::MatrixXd(jacobian));
  Rows all{shape, RowMatrix(residual.size(), basis.cols() + 1), differences};
  all.columns.leftCols(basis.cols()) = basis;
  all.columns.rightCols(1) = residual;
  constexpr int kMostSteps = 30;
  const auto value = [&](const Logs& there) { return LogPosterior(all, prior, there); };
  const Logs top = NewtonAscent(value, FindStart(all, prior), kMostSteps);
  FoundErrors found;
  found.sizes = SizesAt(LongestAllowed(value, top, std::log(prior.center.length)));
  found.uncertainty = InverseOf(-CurvatureAt(value, top));
  double likely = LogLikelihood(shape, found.sizes, all.columns);
  if (!prior.path_is_usual) {
    const Logs alone = BestIndependent(all, prior, top);
    const double without = LogLikelihood(shape, SizesAt(alone), all.columns);
    found.path_gain = 2 * (likely - without);
    if (found.path_gain <= kGainToBelieve) {
      found.sizes = SizesAt(alone);
      found.uncertainty = InverseOf(-CurvatureAt(value, alone));
      likely = without;
    }
  }
  found.gain = 2 * (likely - WhiteLogLikelihood(all));
  return found;
}

}  // namespace lyrefit
