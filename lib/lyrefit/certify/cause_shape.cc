#include "lyrefit/certify/cause_shape.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

// Constants of the collection loss; voltages are those of a cell.
constexpr double kBuiltIn = 0.9;
constexpr double kClosest = 0.03;  // distance from kBuiltIn where the tangent begins
constexpr double kLargestLoss = 0.3;

// The largest product of `factor` with a value of the span.
double Largest(Span span, double factor) {
  if (factor == 0) return 0;
  return std::max(span.lower * factor, span.upper * factor);
}

// Range of x^e for x in a span and e in exponent + shift. ln(x^e) is linear in e and in ln x, so
// the corners have the extreme values.
Span Powers(Span x, Span exponent, double shift) {
  Span range = {kInfinity, 0};
  for (const double base : {x.lower, x.upper}) {
    for (const double e : {exponent.lower + shift, exponent.upper + shift}) {
      const double power = std::pow(base, e);
      range = {std::min(range.lower, power), std::max(range.upper, power)};
    }
  }
  return range;
}

// Range of |v| / reach over a span of v.
Span SizesOf(Span v, double reach) {
  const double a = std::fabs(v.lower) / reach, b = std::fabs(v.upper) / reach;
  const bool crosses = v.lower <= 0 && v.upper >= 0;
  return {crosses ? 0 : std::min(a, b), std::max(a, b)};
}

// Range of the difference between the value at v0 + t (v1 - v0) and the linear interpolation
// between v0 and v1, divided by t (1 - t). It combines a bound from the second derivative and one
// from the range of the slope, which is finite everywhere.
Span Departure(const CauseShape& shape, Span theta, double v0, double v1) {
  const double step = v1 - v0;
  if (step == 0) return {0, 0};
  const Span v = {std::min(v0, v1), std::max(v0, v1)};
  const Span slopes = shape.slopes(v, theta), bends = shape.bends(v, theta);
  // With slopes in [s, S], the value rises from one end by at most S per volt. Towards the other
  // end it rises by at least s per volt.
  const double most = std::fabs(step) * (slopes.upper - slopes.lower);
  const double half = 0.5 * step * step;
  return {std::max(-most, -half * bends.upper), std::min(most, -half * bends.lower)};
}

}  // namespace

CauseShape CollectionShape(int cells, double photocurrent_A) {
  const double ns = cells;
  CauseShape shape;
  shape.strongest_A = kLargestLoss * photocurrent_A;
  shape.value = [ns](double v, double) {
    const double gap = kBuiltIn - v / ns, within = std::max(gap, kClosest);
    return 1 / within + (within - gap) / (kClosest * kClosest) - 1 / kBuiltIn;
  };
  const auto slope = [ns](double v) {
    const double within = std::max(kBuiltIn - v / ns, kClosest);
    return 1 / (within * within * ns);
  };
  shape.slope = [slope](double v, double) { return slope(v); };
  shape.slopes = [slope](Span v, Span) { return Span{slope(v.lower), slope(v.upper)}; };
  shape.bends = [ns](Span v, Span) {
    const auto bend = [ns](double at) {
      const double within = std::max(kBuiltIn - at / ns, kClosest);
      return 2 / (within * within * within * ns * ns);
    };
    const bool reaches_tangent = v.upper / ns > kBuiltIn - kClosest;
    return Span{reaches_tangent ? 0 : bend(v.lower), bend(v.upper)};
  };
  return shape;
}

CauseShape DiodeShape(double u, double pivot_V, double strongest_A) {
  CauseShape shape;
  shape.strongest_A = strongest_A;
  const double scale = 1 / -std::expm1(-u * pivot_V);
  const auto grown = [u, pivot_V, scale](double v) { return scale * std::exp(u * (v - pivot_V)); };
  shape.value = [u, pivot_V](double v, double) {
    const double floor = std::exp(-u * pivot_V);
    return (std::exp(u * (v - pivot_V)) - floor) / (1 - floor);
  };
  shape.slope = [u, grown](double v, double) { return u * grown(v); };
  shape.slopes = [u, grown](Span v, Span) { return Span{u * grown(v.lower), u * grown(v.upper)}; };
  shape.bends = [u, grown](Span v, Span) {
    return Span{u * u * grown(v.lower), u * u * grown(v.upper)};
  };
  return shape;
}

CauseShape PowerShape(double reach_V, Span theta, double strongest_A) {
  CauseShape shape;
  shape.theta = theta;
  shape.strongest_A = strongest_A;
  const double r = reach_V;
  shape.value = [r](double v, double m) { return std::copysign(std::pow(std::fabs(v) / r, m), v); };
  shape.slope = [r](double v, double m) { return m / r * std::pow(std::fabs(v) / r, m - 1); };
  shape.slopes = [r](Span v, Span m) {
    const Span powers = Powers(SizesOf(v, r), m, -1);
    return Span{m.lower / r * powers.lower, m.upper / r * powers.upper};
  };
  shape.bends = [r](Span v, Span m) {
    const Span powers = Powers(SizesOf(v, r), m, -2);
    const double low = m.lower * (m.lower - 1) / (r * r) * powers.lower;
    const double high = m.upper * (m.upper - 1) / (r * r) * powers.upper;
    if (v.lower >= 0) return Span{low, high};
    if (v.upper <= 0) return Span{-high, -low};
    return Span{-high, high};
  };
  shape.theta_bends = [r](double v, Span m) {
    if (v == 0) return Span{0, 0};
    const double x = std::fabs(v) / r, log = std::log(x);
    const double a = log * log * std::pow(x, m.lower), b = log * log * std::pow(x, m.upper);
    const Span size = {std::min(a, b), std::max(a, b)};
    return v > 0 ? size : Span{-size.upper, -size.lower};
  };
  return shape;
}

ShapePull BoundPull(const CauseShape& shape, Span theta, const Eigen::VectorXd& v,
                    const Eigen::VectorXd& z) {
  ShapePull pull;
  pull.ends = -shape.Values(v, theta.lower).dot(z);
  const double width = theta.upper - theta.lower;
  if (!(width > 0)) return pull;
  pull.ends = std::max(pull.ends, -shape.Values(v, theta.upper).dot(z));
  double bend = 0;
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    bend += Largest(shape.theta_bends(v[k], theta), z[k]);
  }
  pull.bulge = 0.125 * width * width * std::max(bend, 0.0);
  return pull;
}

double BoundRise(const CauseShape& shape, Span theta, const Eigen::VectorXd& v0,
                 const Eigen::VectorXd& v1, const Eigen::VectorXd& z0, const Eigen::VectorXd& z1) {
  double rise = 0;
  for (Eigen::Index k = 0; k < v0.size(); ++k) {
    const double step = v1[k] - v0[k];
    Span change = {0, 0};  // of the value
    if (theta.lower == theta.upper) {
      change.lower = change.upper =
          shape.value(v1[k], theta.lower) - shape.value(v0[k], theta.lower);
    } else if (step != 0) {
      const Span v = {std::min(v0[k], v1[k]), std::max(v0[k], v1[k])};
      const Span slopes = shape.slopes(v, theta);
      change = {std::min(slopes.lower * step, slopes.upper * step),
                std::max(slopes.lower * step, slopes.upper * step)};
    }
    rise += Largest(change, z1[k] - z0[k]);
    const Span apart = Departure(shape, theta, v0[k], v1[k]);
    rise += std::max(Largest(apart, -z0[k]), Largest(apart, -z1[k]));
  }
  return 2 * rise;
}

}  // namespace lyrefit
