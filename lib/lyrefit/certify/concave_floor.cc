#include "lyrefit/certify/concave_floor.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/groups.h"

namespace lyrefit {
namespace {

// Least squares fit of a concave curve that never rises to readings in order of rising voltage. The
// curve is a constant less non-negative multiples of hinges max(x - knot, 0) over the length of the
// piece beyond the knot. The first possible knot is at the first voltage. Solved by active sets
// (Lawson and Hanson 1974, chapter 23).
class ConcaveFit {
 public:
  ConcaveFit(const Eigen::VectorXd& x, const Eigen::VectorXd& b) : x_(x), b_(b) {}

  // A lower bound of half the sum of squares of the `count` readings from `first` on. `knots` has
  // the knots of the previous call, which are the start where they lie inside, and returns the new
  // ones.
  double Bound(Eigen::Index first, Eigen::Index count, std::vector<double>* knots) {
    first_ = first;
    count_ = count;
    last_ = x_[first + count - 1];
    if (count < 2 || !(last_ > x_[first])) return Finish(WithMean(), 0);
    std::vector<double> active;
    for (const double knot : *knots) {
      if (knot >= x_[first] && knot < last_) active.push_back(knot);
    }
    Eigen::VectorXd y = Settle(&active);
    double excess = 0;
    for (Eigen::Index round = 0; round < 3 * count + 10; ++round) {
      double wanted = 0;
      excess = MostWanted(y, &wanted);
      const bool known = std::find(active.begin(), active.end(), wanted) != active.end();
      if (excess <= 1e-12 * b_.cwiseAbs().maxCoeff() || known) break;
      active.push_back(wanted);
      std::sort(active.begin(), active.end());
      y = Settle(&active);
    }
    *knots = active;
    return Finish(y, excess);
  }

 private:
  Eigen::VectorXd Piece() const { return b_.segment(first_, count_); }

  Eigen::VectorXd WithMean() const {
    const Eigen::VectorXd b = Piece();
    return b.array() - b.mean();
  }

  Eigen::MatrixXd Columns(const std::vector<double>& knots) const {
    Eigen::MatrixXd a(count_, static_cast<Eigen::Index>(knots.size()) + 1);
    a.col(0).setOnes();
    for (std::size_t j = 0; j < knots.size(); ++j) {
      a.col(static_cast<Eigen::Index>(j) + 1) =
          (-(x_.segment(first_, count_).array() - knots[j]).max(0) / (last_ - knots[j])).matrix();
    }
    return a;
  }

  // Drops knots until all multiples are positive. Returns the residual.
  Eigen::VectorXd Settle(std::vector<double>* knots) const {
    for (;;) {
      const Eigen::MatrixXd a = Columns(*knots);
      const Eigen::VectorXd parts = LeastSquares(a, Piece());
      Eigen::Index worst = 0;
      const double least = knots->empty() ? 1 : parts.tail(a.cols() - 1).minCoeff(&worst);
      if (least > 0) return WithoutColumns(a, Residual(Piece(), a, parts));
      knots->erase(knots->begin() + worst);
    }
  }

  // The largest gradient of a hinge along y, and its knot. A hinge with a knot between two voltages
  // lies between the hinges with knots at them, so only the voltages are candidates.
  double MostWanted(const Eigen::VectorXd& y, double* knot) const {
    double best = 0, sum = 0, moment = 0;
    for (Eigen::Index k = count_ - 1; k >= 0; --k) {
      const double x = x_[first_ + k];
      sum += y[k];
      moment += y[k] * x;
      if (!(x < last_)) continue;
      const double pull = (x * sum - moment) / (last_ - x);
      if (pull <= best) continue;
      best = pull;
      *knot = x;
    }
    return best;
  }

  // Weak duality: b . y - |y|^2 / 2 less the largest gain of the hinges. Their multiples add up to
  // the drop of the curve. The drop is bounded for every curve that fits no worse than a constant.
  double Finish(const Eigen::VectorXd& y, double excess) const {
    const Eigen::VectorXd b = Piece();
    const double drop = b.maxCoeff() - b.minCoeff() + 2 * WithMean().norm();
    return std::max(0.0, b.dot(y) - 0.5 * y.squaredNorm() - excess * drop);
  }

  const Eigen::VectorXd& x_;
  const Eigen::VectorXd& b_;
  Eigen::Index first_ = 0, count_ = 0;
  double last_ = 0;
};

}  // namespace

ConcaveFloor FindConcaveFloor(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A, double bend_V) {
  const auto points = static_cast<Eigen::Index>(voltage_V.size());
  const std::vector<int> order = RisingOrder(voltage_V);
  Eigen::VectorXd x(points), b(points);
  for (Eigen::Index k = 0; k < points; ++k) {
    x[k] = voltage_V[order[static_cast<std::size_t>(k)]];
    b[k] = current_A[order[static_cast<std::size_t>(k)]];
  }
  ConcaveFit fit(x, b);
  // Half sums of squares of the first k readings and of the last k readings.
  std::vector<double> first(voltage_V.size() + 1, 0), last(voltage_V.size() + 1, 0);
  std::vector<double> knots;
  for (Eigen::Index k = 1; k <= points; ++k)
    first[static_cast<std::size_t>(k)] = fit.Bound(0, k, &knots);
  knots.clear();
  for (Eigen::Index k = 1; k <= points; ++k) {
    last[static_cast<std::size_t>(k)] = fit.Bound(points - k, k, &knots);
  }
  ConcaveFloor floor;
  double best = first.back();
  for (Eigen::Index k = 1; k < points; ++k) {
    Eigen::Index second = std::min<Eigen::Index>(k + kBendReadings, points);
    while (second < points && x[second] <= x[k - 1] + bend_V) ++second;
    const Eigen::Index rest = points - second;
    const double half = first[static_cast<std::size_t>(k)] + last[static_cast<std::size_t>(rest)];
    if (rest == 0 || half >= best) continue;
    best = half;
    floor.step_V = x[k - 1];
  }
  const double count = static_cast<double>(points);
  floor.smooth_A = std::sqrt(2 * first.back() / count);
  floor.step_A = std::sqrt(2 * best / count);
  return floor;
}

}  // namespace lyrefit
