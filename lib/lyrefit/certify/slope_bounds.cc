#include "lyrefit/certify/solved_part.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/dense.h"
#include "lyrefit/certify/correlation.h"

namespace lyrefit {
namespace {

constexpr double kStep = 0.05;        // of the differences, in u x voltage of the steepest diode
constexpr double kSampleWidth = 0.8;  // between two samples of u, in u x voltage
constexpr Eigen::Index kMostPoints = 64;  // points that are bounded individually
constexpr double kLeftOverWeight = 4;     // weight of the remainder against the values' uncertainty

// Four-point difference for the slope -dI/dVd of a falling law. For every exponential with positive
// weight the backward difference is a lower bound and the forward difference an upper bound.
struct Difference {
  double voltage_V[4];
  double weight[4];
};

Difference Below(double x, double h) {
  return {{x, x - h, x - 2 * h, x - 3 * h}, {-11 / (6 * h), 3 / h, -1.5 / h, 1 / (3 * h)}};
}

Difference Above(double x, double h) {
  return {{x, x + h, x + 2 * h, x + 3 * h}, {11 / (6 * h), -3 / h, 1.5 / h, -1 / (3 * h)}};
}

// Columns of the cone of laws at a junction voltage: light, leak, then diodes at samples of u.
struct Columns {
  std::vector<double> u;
  double scale_V = 0;
  std::vector<double> largest;  // coefficient of each column

  std::size_t size() const { return 2 + u.size(); }
  double Value(std::size_t column, double vd) const {
    if (column == 0) return 1;
    if (column == 1) return -vd / scale_V;
    const double at = u[column - 2];
    return -(std::exp((vd - scale_V) * at) - std::exp(-at * scale_V)) / -std::expm1(-at * scale_V);
  }
  double Value(std::size_t column, const Difference& difference) const {
    double value = 0;
    for (int i = 0; i < 4; ++i) {
      value += difference.weight[i] * Value(column, difference.voltage_V[i]);
    }
    return value;
  }
};

Columns SampleColumns(const KnownValues& known, const std::vector<Window>& windows) {
  Columns columns;
  columns.scale_V = known.dark_bound.voltage_V;
  for (const Window& window : windows) {
    const double span = (window.upper - window.lower) * columns.scale_V;
    const int count = std::min(std::max(3, static_cast<int>(span / kSampleWidth) + 2), 60);
    for (int i = 0; i < count; ++i) {
      columns.u.push_back(window.lower + (window.upper - window.lower) * i / (count - 1));
    }
  }
  columns.largest.assign(columns.size(), known.dark_bound.current_A);
  columns.largest[0] = known.largest_light_A;
  return columns;
}

double Uncertainty(const KnownValues& known, const Eigen::VectorXd& c) {
  return known.each_A.dot(c.cwiseAbs()) + known.radius_A * known.shared.cwiseProduct(c).norm() +
         std::fabs(known.common_A.dot(c));
}

// An upper bound of `sign` x (difference - c . values) over all laws of the cone.
double LeftOver(const KnownValues& known, const std::vector<Window>& windows,
                const Columns& columns, const Difference& difference, const Eigen::VectorXd& c,
                double sign, double allowed) {
  const Eigen::Index nodes = c.size();
  Eigen::VectorXd voltage(nodes + 4), weight(nodes + 4);
  voltage.head(nodes) = known.voltage_V;
  weight.head(nodes) = -sign * c;
  for (int i = 0; i < 4; ++i) {
    voltage[nodes + i] = difference.voltage_V[i];
    weight[nodes + i] = sign * difference.weight[i];
  }
  double left = std::max(weight.sum(), 0.0) * columns.largest[0];
  left += std::max(-voltage.dot(weight) / columns.scale_V, 0.0) * known.dark_bound.current_A;
  const double dark_bound = known.dark_bound.current_A;
  return left + dark_bound * BoundCorrelation(voltage, columns.scale_V, weight, windows, {},
                                              allowed / std::max(dark_bound, 1e-300))
                                 .bound;
}

std::vector<SlopeRange> BoundAll(const KnownValues& known, const std::vector<Window>& windows,
                                 const std::vector<double>& below_V,
                                 const std::vector<double>& above_V, double precision_S) {
  const auto count = static_cast<Eigen::Index>(below_V.size());
  const Eigen::Index nodes = known.voltage_V.size();
  double steepest = 0;
  for (const Window& window : windows) steepest = std::max(steepest, window.upper);
  const double h = kStep / steepest;
  const Columns columns = SampleColumns(known, windows);
  const auto samples = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(samples + nodes, nodes);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(samples + nodes, 2 * count);
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double weight = kLeftOverWeight * columns.largest[i];
    for (Eigen::Index m = 0; m < nodes; ++m) {
      a(i, m) = weight * columns.Value(i, known.voltage_V[m]);
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      b(i, 2 * k) = weight * columns.Value(i, Below(below_V[k], h));
      b(i, 2 * k + 1) = weight * columns.Value(i, Above(above_V[k], h));
    }
  }
  for (Eigen::Index m = 0; m < nodes; ++m) {
    a(samples + m, m) =
        known.each_A[m] + known.radius_A * known.shared[m] + std::fabs(known.common_A[m]);
  }
  const Eigen::MatrixXd c = LeastSquares(a, b);
  std::vector<SlopeRange> ranges(below_V.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd low = c.col(2 * k), high = c.col(2 * k + 1);
    SlopeRange& range = ranges[k];
    range.lower = std::max(
        0.0, low.dot(known.value_A) - Uncertainty(known, low) -
                 LeftOver(known, windows, columns, Below(below_V[k], h), low, -1, precision_S));
    range.upper = high.dot(known.value_A) + Uncertainty(known, high) +
                  LeftOver(known, windows, columns, Above(above_V[k], h), high, 1, precision_S);
  }
  return ranges;
}

// Selects kMostPoints points evenly by rank of junction voltage, including the first and the last.
std::vector<Eigen::Index> Anchors(const Eigen::VectorXd& voltage_V) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(voltage_V.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return voltage_V[a] < voltage_V[b]; });
  std::vector<Eigen::Index> anchors;
  anchors.reserve(kMostPoints);
  for (int i = 0; i < kMostPoints; ++i) {
    anchors.push_back(order[i * (order.size() - 1) / (kMostPoints - 1)]);
  }
  return anchors;
}

KnownValues Thinned(const KnownValues& known, const std::vector<Eigen::Index>& anchors) {
  KnownValues thin = known;
  thin.voltage_V = known.voltage_V(anchors);
  thin.value_A = known.value_A(anchors);
  thin.each_A = known.each_A(anchors);
  thin.shared = known.shared(anchors);
  thin.common_A = known.common_A(anchors);
  return thin;
}

// Bounds of the slope at one voltage from bounds at others. The slope is a sum of exponentials: it
// rises, and its logarithm is convex. Chords of the logarithm bound it from above between their
// ends. Their extensions bound it from below outside them.
double UpperBetween(const std::vector<double>& at_V, const std::vector<double>& upper, double v) {
  double least = kInfinity;
  for (std::size_t i = 0; i < at_V.size(); ++i) {
    if (at_V[i] >= v) least = std::min(least, upper[i]);
  }
  for (std::size_t i = 0; i + 1 < at_V.size(); ++i) {
    const double width = at_V[i + 1] - at_V[i];
    if (!(at_V[i] <= v && v <= at_V[i + 1] && width > 0) || !(upper[i] > 0)) continue;
    const double t = (v - at_V[i]) / width;
    least = std::min(least, std::exp((1 - t) * std::log(upper[i]) + t * std::log(upper[i + 1])));
  }
  return least;
}

double LowerBetween(const std::vector<double>& at_V, const std::vector<double>& lower,
                    const std::vector<double>& upper, double v) {
  double most = 0;
  const auto tail = [&](std::size_t end, std::size_t other) {
    const double t = (v - at_V[end]) / (at_V[end] - at_V[other]);
    if (!(lower[end] > 0) || !(upper[other] < kInfinity) || !(t >= 0)) return;
    most = std::max(most, lower[end] * std::pow(lower[end] / upper[other], t));
  };
  for (std::size_t i = 0; i < at_V.size(); ++i) {
    if (at_V[i] <= v) most = std::max(most, lower[i]);
    if (i > 0 && at_V[i] > at_V[i - 1]) {
      if (at_V[i] <= v) tail(i, i - 1);
      if (at_V[i - 1] >= v) tail(i - 1, i);
    }
  }
  return most;
}

}  // namespace

std::vector<SlopeRange> BoundSlopes(const KnownValues& known, const std::vector<Window>& windows,
                                    const std::vector<double>& below_V,
                                    const std::vector<double>& above_V, double precision_S) {
  if (known.voltage_V.size() <= kMostPoints) {
    return BoundAll(known, windows, below_V, above_V, precision_S);
  }
  const std::vector<Eigen::Index> anchors = Anchors(known.voltage_V);
  std::vector<double> below;
  below.reserve(anchors.size());
  for (const Eigen::Index k : anchors) below.push_back(known.voltage_V[k]);
  std::vector<double> above = below;
  below.front() = std::min(below.front(), *std::min_element(below_V.begin(), below_V.end()));
  above.back() = std::max(above.back(), *std::max_element(above_V.begin(), above_V.end()));
  std::vector<double> lower, upper;
  for (const SlopeRange& range :
       BoundAll(Thinned(known, anchors), windows, below, above, precision_S)) {
    lower.push_back(range.lower);
    upper.push_back(range.upper);
  }
  std::vector<SlopeRange> ranges;
  for (std::size_t k = 0; k < below_V.size(); ++k) {
    ranges.push_back(
        {LowerBetween(below, lower, upper, below_V[k]), UpperBetween(above, upper, above_V[k])});
  }
  return ranges;
}

}  // namespace lyrefit
