#include "lyrefit/certify/correlation.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

// Pieces no wider than this in u x voltage, so that an exponential changes little within one.
constexpr double kWidestPiece = 0.4;
constexpr int kDeepest = 48;
constexpr double kHighestExponent = 600;  // beyond it nothing is bounded

// Value and slope of the correlation at u, times a positive factor that is the same for the whole
// piece: (exp(u0 Vref) - 1) is divided by for the piece's lower end u0, which only enlarges it.
struct Piece {
  double lower, upper;
  int depth;
};

class Search {
 public:
  Search(const Eigen::VectorXd& vd, double scale, const Eigen::VectorXd& y, double allowed)
      : vd_(vd.array()), y_(y.array()), scale_(scale), allowed_(allowed) {}

  void Look(const Piece& first) {
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
  // Bounds the piece; true if that ends the matter.
  bool Settled(const Piece& piece) {
    const double h = piece.upper - piece.lower;
    const double factor = -1 / -std::expm1(-piece.lower * scale_);
    const double floor = std::exp(-piece.lower * scale_);
    const Eigen::ArrayXd low = ((vd_ - scale_) * piece.lower).exp();
    const Eigen::ArrayXd high = (vd_ * piece.upper - scale_ * piece.lower).exp();
    const double c0 = factor * (y_ * (low - floor)).sum();
    const double c1 = factor * (y_ * (high - floor)).sum();
    const double slope0 = factor * (y_ * vd_ * low).sum();
    const double slope1 = factor * (y_ * vd_ * high).sum();
    // Second derivative: factor x sum y vd^2 exp(u vd - u0 Vs). It lies between the least and the
    // largest of the four control points of the cubic through its values and slopes at both ends,
    // as far as its own fourth derivative lets it.
    const Eigen::ArrayXd weight = factor * y_ * vd_.square();
    const double bend0 = (weight * low).sum();
    const double bend1 = (weight * high).sum();
    const double inner0 = bend0 + h / 3 * (weight * vd_ * low).sum();
    const double inner1 = bend1 - h / 3 * (weight * vd_ * high).sum();
    const double bulge =
        h * h * h * h / 384 * (weight.abs() * vd_.square().square() * low.max(high)).sum();
    const double bend_low = std::min({bend0, inner0, inner1, bend1}) - bulge;
    const double bend_high = std::max({bend0, inner0, inner1, bend1}) + bulge;
    Note(c0, piece.lower);
    Note(c1, piece.upper);
    const double ends = std::max(c0, c1);
    double bound = ends + 0.125 * h * h * std::max(0.0, -bend_low);
    if (bend_high <= 0) bound = std::min(bound, ConcaveBound(c0, c1, slope0, slope1, h));
    const bool known_above = ends > allowed_ && bound <= 1.01 * ends;
    if (bound > allowed_ && !known_above && piece.depth < kDeepest) return false;
    result_.bound = std::max(result_.bound, bound);
    return true;
  }

  static double ConcaveBound(double c0, double c1, double slope0, double slope1, double h) {
    if (slope0 <= 0) return c0;
    if (slope1 >= 0) return c1;
    const double t = (c1 - c0 - slope1 * h) / (slope0 - slope1);
    return std::max(std::max(c0, c1), c0 + slope0 * std::min(std::max(t, 0.0), h));
  }

  void Note(double c, double u) {
    if (c <= result_.best) return;
    result_.best = c;
    result_.best_u = u;
  }

  const Eigen::ArrayXd vd_;
  const Eigen::ArrayXd y_;
  const double scale_;
  const double allowed_;
  Correlation1D result_;
};

// An upper bound of the correlation a(u) . y over u in [u0, u1], good enough to tell pieces where
// it is far below zero.
double RoughBound(const Eigen::ArrayXd& vd, double scale, const Eigen::ArrayXd& y, double u0,
                  double u1) {
  const Eigen::ArrayXd low = ((vd - scale) * u0).exp();
  const Eigen::ArrayXd high = (vd * u1 - scale * u0).exp();
  const double factor = 1 / std::expm1(-u0 * scale);
  const double floor = std::exp(-u0 * scale);
  const Eigen::ArrayXd bend = factor * y * vd.square();
  const double below = (bend * low).min(bend * high).sum();
  return factor * std::min((y * (low - floor)).sum(), (y * (high - floor)).sum()) +
         0.125 * (u1 - u0) * (u1 - u0) * std::max(0.0, -below);
}

int PieceCount(const Window& window, const Eigen::VectorXd& vd) {
  const double span = (window.upper - window.lower) * vd.cwiseAbs().maxCoeff();
  return std::max(1, static_cast<int>(std::ceil(span / kWidestPiece)));
}

}  // namespace

Correlation1D BoundCorrelation(const Eigen::VectorXd& vd, double scale_voltage_V,
                               const Eigen::VectorXd& y, const std::vector<Window>& windows,
                               const std::vector<Atom>& marks, double allowed) {
  Search search(vd, scale_voltage_V, y, allowed);
  for (const Window& window : windows) {
    std::vector<double> ends;
    const int count = PieceCount(window, vd);
    for (int i = 0; i <= count; ++i) {
      ends.push_back(window.lower + (window.upper - window.lower) * i / count);
    }
    for (const Atom& mark : marks) {
      if (mark.u > window.lower && mark.u < window.upper) ends.push_back(mark.u);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) search.Look({ends[i], ends[i + 1], 0});
  }
  return search.result();
}

double BoundBend(const MixtureData& data, const std::vector<Window>& windows, double rs, double dr,
                 const Eigen::VectorXd& y0, const Eigen::VectorXd& y1, double scale_voltage_V) {
  const Eigen::ArrayXd current = data.current_A.array();
  const Eigen::ArrayXd v0 = data.voltage_V.array() + rs * current;
  const Eigen::ArrayXd v1 = v0 + dr * current;
  const Eigen::ArrayXd step = (y1 - y0).array();
  const Eigen::ArrayXd y_high = y0.array().max(y1.array());
  double bend = 0;
  // Keeps the largest of those columns whose correlation can rise above zero between the ends.
  const auto keep = [&bend](double column_bend, double ends) {
    if (ends + 0.125 * column_bend > 0) bend = std::max(bend, column_bend);
  };
  keep(2 * dr * (current * step).sum() / scale_voltage_V,
       -std::min((v0 * y0.array()).sum(), (v1 * y1.array()).sum()) / scale_voltage_V);
  for (const Window& window : windows) {
    const int count = std::max(PieceCount(window, v0.matrix()), PieceCount(window, v1.matrix()));
    const double width = (window.upper - window.lower) / count;
    for (int i = 0; i < count; ++i) {
      const double u0 = window.lower + i * width;
      const double u1 = u0 + width;
      // Each point adds exp(u v) ((u dr I)^2 y + 2 u dr I dy), bounded term by term.
      const Eigen::ArrayXd square = (dr * current).square() * y_high;
      const Eigen::ArrayXd cross = 2 * dr * current * step;
      const Eigen::ArrayXd factor =
          (square * (u0 * u0)).max(square * (u1 * u1)) + (cross * u0).max(cross * u1);
      const Eigen::ArrayXd exponent_low =
          (v0 * u0).min(v0 * u1).min((v1 * u0).min(v1 * u1)) - u0 * scale_voltage_V;
      const Eigen::ArrayXd exponent_high =
          (v0 * u0).max(v0 * u1).max((v1 * u0).max(v1 * u1)) - u0 * scale_voltage_V;
      if (exponent_high.maxCoeff() > kHighestExponent) {
        return kInfinity;
      }
      const double sum = (factor * exponent_low.exp()).max(factor * exponent_high.exp()).sum();
      const double column_bend = sum / -std::expm1(-u0 * scale_voltage_V);
      if (column_bend <= bend) continue;
      keep(column_bend, std::max(RoughBound(v0, scale_voltage_V, y0.array(), u0, u1),
                                 RoughBound(v1, scale_voltage_V, y1.array(), u0, u1)));
    }
  }
  return bend;
}

}  // namespace lyrefit
