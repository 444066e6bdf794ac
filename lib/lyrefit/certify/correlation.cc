#include "lyrefit/certify/correlation.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/real_data.h"

namespace lyrefit {
namespace {

// Largest width of a piece in u x voltage, so that an exponential changes little within one.
constexpr double kWidestPiece = 0.4;
constexpr int kDeepest = 48;
constexpr double kHighestExponent = 600;  // larger exponents make BoundBend() infinite

// A piece of a window of u, halved `depth` times. Within a piece the columns are divided by
// exp(u0 Vs) - 1 for its lower end u0, where Vs is the scale voltage. This divisor is positive and
// at most the exact one at u, so positive correlations are only overestimated.
struct Piece {
  double lower, upper;
  int depth;
};

using std::exp;
using std::max;
using std::min;

// The exponents u1 vd - u0 scale.
ArrayOf<double> ExponentAtEnd(const ArrayOf<double>& vd, double scale, double u0, double u1) {
  return vd * u1 - scale * u0;
}
// The exponents in intervals, with less rounding where vd is close to the scale and the terms are
// largest.
ArrayOf<Interval> ExponentAtEnd(const ArrayOf<Interval>& vd, const Interval& scale, double u0,
                                double u1) {
  return (vd - scale) * Interval(u0) + vd * (Interval(u1) - Interval(u0));
}

template <class Real>
class Search {
 public:
  Search(const ArrayOf<Real>& vd, double scale, const ArrayOf<Real>& y, double allowed)
      : vd_(vd), y_(y), scale_(scale), allowed_(allowed) {}

  // Bisects a piece until it is bounded. `pull` is the multiplier of Is of its window.
  void Look(const Piece& first, double pull) {
    pull_ = Real(pull);
    std::vector<Piece> open = {first};
    while (!open.empty()) {
      const Piece piece = open.back();
      open.pop_back();
      const double middle = 0.5 * (piece.lower + piece.upper);
      if (Settled(piece)) continue;
      open.push_back({middle, piece.upper, piece.depth + 1});
      open.push_back({piece.lower, middle, piece.depth + 1});
    }
  }

  const Correlation1D& result() const { return result_; }

 private:
  // Bounds the piece; true if it needs no bisection.
  bool Settled(const Piece& piece) {
    const Real lower(piece.lower);
    const Real h = Real(piece.upper) - lower;
    const Real factor = Real(-1) / -ExpMinus1(-lower * scale_);
    const Real floor = exp(-lower * scale_);
    const ArrayOf<Real> low = ((vd_ - scale_) * lower).exp();
    const ArrayOf<Real> high = ExponentAtEnd(vd_, scale_, piece.lower, piece.upper).exp();
    const Real c0 = factor * ((y_ * (low - floor)).sum() + pull_ * floor);
    const Real c1 = factor * ((y_ * (high - floor)).sum() + pull_ * floor);
    const Real slope0 = factor * (y_ * vd_ * low).sum();
    const Real slope1 = factor * (y_ * vd_ * high).sum();
    // Second derivative: factor x sum y vd^2 exp(u vd - u0 Vs). Its cubic interpolant through the
    // values and slopes at both ends lies within the range of its four control points. The
    // interpolation error is bounded by the fourth derivative of the second derivative.
    const ArrayOf<Real> weight = factor * y_ * vd_.square();
    const Real bend0 = (weight * low).sum();
    const Real bend1 = (weight * high).sum();
    const Real inner0 = bend0 + h / 3.0 * (weight * vd_ * low).sum();
    const Real inner1 = bend1 - h / 3.0 * (weight * vd_ * high).sum();
    const Real bulge =
        h * h * h * h / 384.0 * (weight.abs() * vd_.square().square() * low.max(high)).sum();
    const Real bend_low = min(min(bend0, inner0), min(inner1, bend1)) - bulge;
    const Real bend_high = max(max(bend0, inner0), max(inner1, bend1)) + bulge;
    Note(Upper(c0), piece.lower);
    Note(Upper(c1), piece.upper);
    const double ends = std::max(Upper(c0), Upper(c1));
    double bound = Upper(Real(ends) + 0.125 * h * h * std::max(0.0, -Lower(bend_low)));
    if (Upper(bend_high) <= 0) bound = std::min(bound, ConcaveBound(c0, c1, slope0, slope1, h));
    const bool known_above = ends > allowed_ && bound <= 1.01 * ends;
    if (bound > allowed_ && !known_above && piece.depth < kDeepest) return false;
    result_.bound = std::max(result_.bound, bound);
    return true;
  }

  // Bounds a concave piece by its tangents: the larger slope at the lower end and the smaller one
  // at the upper end.
  static double ConcaveBound(const Real& c0, const Real& c1, const Real& slope0, const Real& slope1,
                             const Real& h) {
    if (Upper(slope0) <= 0) return Upper(c0);
    if (Lower(slope1) >= 0) return Upper(c1);
    const Real s0(Upper(slope0)), s1(Lower(slope1)), e0(Upper(c0)), e1(Upper(c1));
    const Real t = (e1 - e0 - s1 * h) / (s0 - s1);
    return std::max(std::max(Upper(e0), Upper(e1)),
                    Upper(e0 + s0 * std::min(std::max(Upper(t), 0.0), Upper(h))));
  }

  void Note(double c, double u) {
    if (c <= result_.best) return;
    result_.best = c;
    result_.best_u = u;
  }

  const ArrayOf<Real> vd_;
  const ArrayOf<Real> y_;
  const Real scale_;
  const double allowed_;
  Real pull_ = Real(0);
  Correlation1D result_;
};

// A rough upper bound of the correlation a(u) . y over u in [u0, u1], tight enough to identify
// pieces far below zero.
template <class Real>
double RoughBound(const ArrayOf<Real>& vd, const Real& scale, const ArrayOf<Real>& y, double pull,
                  double u0, double u1) {
  const ArrayOf<Real> low = ((vd - scale) * Real(u0)).exp();
  const ArrayOf<Real> high = ExponentAtEnd(vd, scale, u0, u1).exp();
  const Real factor = Real(1) / ExpMinus1(Real(-u0) * scale);
  const Real floor = exp(Real(-u0) * scale);
  const ArrayOf<Real> bend = factor * y * vd.square();
  const Real below = (bend * low).min(bend * high).sum();
  const Real h = Real(u1) - Real(u0);
  const Real priced = Real(pull) * floor;
  return Upper(factor * (min((y * (low - floor)).sum(), (y * (high - floor)).sum()) + priced) +
               0.125 * h * h * std::max(0.0, -Lower(below)));
}

template <class Real>
double LargestSize(const ArrayOf<Real>& vd) {
  return Upper(vd.abs().maxCoeff());
}

int PieceCount(const Window& window, double largest_vd) {
  const double span = (window.upper - window.lower) * largest_vd;
  return std::max(1, static_cast<int>(std::ceil(span / kWidestPiece)));
}

double PullOf(const std::vector<double>& pulls, std::size_t window) {
  return pulls.empty() ? 0 : pulls[window];
}

// The ends of `count` equal pieces of a window, in rising order.
std::vector<double> PieceEnds(const Window& window, int count) {
  std::vector<double> ends;
  for (int i = 0; i <= count; ++i) {
    ends.push_back(window.lower + (window.upper - window.lower) * i / count);
  }
  return ends;
}

}  // namespace

template <class Real>
Correlation1D BoundCorrelation(const ArrayOf<Real>& vd, double scale_voltage_V,
                               const ArrayOf<Real>& y, const std::vector<Window>& windows,
                               const std::vector<Atom>& marks, double allowed,
                               const std::vector<double>& pulls) {
  Search<Real> search(vd, scale_voltage_V, y, allowed);
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const Window& window = windows[w];
    std::vector<double> ends = PieceEnds(window, PieceCount(window, LargestSize(vd)));
    ends.back() = window.upper;
    for (const Atom& mark : marks) {
      if (mark.u > window.lower && mark.u < window.upper) ends.push_back(mark.u);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      search.Look({ends[i], ends[i + 1], 0}, PullOf(pulls, w));
    }
  }
  return search.result();
}

template <class Real>
double BoundBend(const MixtureData& data, const std::vector<Window>& windows, double rs0,
                 double rs1, const Eigen::VectorXd& y0, const Eigen::VectorXd& y1,
                 double scale_voltage_V, const std::vector<double>& pulls0,
                 const std::vector<double>& pulls1) {
  const Real scale(scale_voltage_V);
  const Real dr = Real(rs1) - Real(rs0);
  const ArrayOf<Real> current = RealArray<Real>(data.current_A);
  const ArrayOf<Real> v0 = JunctionVoltage<Real>(data, rs0);
  const ArrayOf<Real> v1 = v0 + dr * current;
  const ArrayOf<Real> z0 = WeightedArray<Real>(data, y0);
  const ArrayOf<Real> z1 = WeightedArray<Real>(data, y1);
  const ArrayOf<Real> step = z1 - z0;
  const ArrayOf<Real> z_high = z0.max(z1);
  const ArrayOf<Real> square = (dr * current).square() * z_high;
  const ArrayOf<Real> cross = Real(2) * dr * current * step;
  double bend = 0;
  // Keeps the largest of the columns whose correlation can rise above zero between the ends.
  const auto keep = [&bend](double column_bend, double ends) {
    if (Upper(Real(ends) + Real(0.125) * column_bend) > 0) bend = std::max(bend, column_bend);
  };
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const Window& window = windows[w];
    const double pull0 = PullOf(pulls0, w), pull1 = PullOf(pulls1, w);
    const int count =
        std::max(PieceCount(window, LargestSize(v0)), PieceCount(window, LargestSize(v1)));
    const double width = (window.upper - window.lower) / count;
    for (int i = 0; i < count; ++i) {
      const double u0 = window.lower + i * width;
      // Rounding leaves no gap before the next piece.
      const double next = i + 1 < count ? window.lower + (i + 1) * width : window.upper;
      const double u1 = std::max(u0 + width, next);
      // Each point adds exp(u v) ((u dr I)^2 y + 2 u dr I dy), bounded term by term.
      const Real low(u0), high(u1);
      const ArrayOf<Real> factor =
          (square * (low * low)).max(square * (high * high)) + (cross * low).max(cross * high);
      const ArrayOf<Real> exponent_low =
          (v0 * low).min(v0 * high).min((v1 * low).min(v1 * high)) - low * scale;
      const ArrayOf<Real> exponent_high =
          (v0 * low).max(v0 * high).max((v1 * low).max(v1 * high)) - low * scale;
      if (Upper(exponent_high.maxCoeff()) > kHighestExponent) {
        return kInfinity;
      }
      const Real sum = (factor * exponent_low.exp()).max(factor * exponent_high.exp()).sum();
      const double column_bend = Upper(sum / -ExpMinus1(-low * scale));
      if (column_bend <= bend) continue;
      keep(column_bend, std::max(RoughBound(v0, scale, z0, pull0, u0, u1),
                                 RoughBound(v1, scale, z1, pull1, u0, u1)));
    }
  }
  return bend;
}

template Correlation1D BoundCorrelation(const ArrayOf<double>&, double, const ArrayOf<double>&,
                                        const std::vector<Window>&, const std::vector<Atom>&,
                                        double, const std::vector<double>&);
template Correlation1D BoundCorrelation(const ArrayOf<Interval>&, double, const ArrayOf<Interval>&,
                                        const std::vector<Window>&, const std::vector<Atom>&,
                                        double, const std::vector<double>&);
template double BoundBend<double>(const MixtureData&, const std::vector<Window>&, double, double,
                                  const Eigen::VectorXd&, const Eigen::VectorXd&, double,
                                  const std::vector<double>&, const std::vector<double>&);
template double BoundBend<Interval>(const MixtureData&, const std::vector<Window>&, double, double,
                                    const Eigen::VectorXd&, const Eigen::VectorXd&, double,
                                    const std::vector<double>&, const std::vector<double>&);

}  // namespace lyrefit
