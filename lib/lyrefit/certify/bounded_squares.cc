#include "lyrefit/certify/bounded_squares.h"

#include <algorithm>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

// Least squares over the columns in `active`, the unknowns that are free; the others stay at x.
Eigen::VectorXd SolveActive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                            const std::vector<int>& active, Eigen::VectorXd x) {
  for (const int i : active) x[i] = 0;
  const Eigen::VectorXd rest = x.isZero(0) ? b : Residual(b, a, x);
  Eigen::MatrixXd columns(a.rows(), active.size());
  for (std::size_t i = 0; i < active.size(); ++i) columns.col(i) = a.col(active[i]);
  const Eigen::VectorXd solution = LeastSquares(columns, rest);
  for (std::size_t i = 0; i < active.size(); ++i) x[active[i]] = solution[i];
  return x;
}

// Step length from x to target, the unknown that limits it (-1: none), and the end of its range.
struct Way {
  double reach = 1;
  int blocking = -1;
  double end = 0;
};

Way WayTo(const Eigen::VectorXd& target, const Eigen::VectorXd& x, const Eigen::VectorXd& lower,
          const Eigen::VectorXd& upper, const std::vector<int>& active) {
  Way way;
  for (const int i : active) {
    const bool below = target[i] <= lower[i];
    if (!below && target[i] < upper[i]) continue;
    const double end = below ? lower[i] : upper[i];
    const double fraction = x[i] == end ? 0 : (end - x[i]) / (target[i] - x[i]);
    if (way.blocking >= 0 && fraction >= way.reach) continue;
    way = {fraction, i, end};
  }
  return way;
}

// The column outside `active` along which the sum of squares falls most steeply, per column norm,
// when its unknown leaves its end. -1 if none exceeds rounding.
int MostWanted(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
               const Eigen::VectorXd& upper, const Eigen::VectorXd& x,
               const std::vector<int>& active) {
  const Eigen::VectorXd y = Residual(b, a, x);
  int best = -1;
  double strongest = 1e-15 * b.norm();
  for (int i = 0; i < static_cast<int>(a.cols()); ++i) {
    if (std::find(active.begin(), active.end(), i) != active.end()) continue;
    if (!(lower[i] < upper[i])) continue;
    const double pull = a.col(i).dot(y) / a.col(i).norm() * (x[i] <= lower[i] ? 1 : -1);
    if (pull <= strongest) continue;
    strongest = pull;
    best = i;
  }
  return best;
}

}  // namespace

Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             Eigen::VectorXd x) {
  const int count = static_cast<int>(a.cols());
  std::vector<int> active;
  for (int i = 0; i < count; ++i) {
    if (lower[i] < upper[i]) active.push_back(i);
  }
  for (int round = 0; round < 6 * count; ++round) {
    while (!active.empty()) {
      const Eigen::VectorXd target = SolveActive(a, b, active, x);
      const Way way = WayTo(target, x, lower, upper, active);
      for (const int i : active) x[i] += way.reach * (target[i] - x[i]);
      if (way.blocking < 0) break;
      x[way.blocking] = way.end;
      active.erase(std::find(active.begin(), active.end(), way.blocking));
    }
    const int best = MostWanted(a, b, lower, upper, x, active);
    if (best < 0) break;
    active.push_back(best);
  }
  return x;
}

}  // namespace lyrefit
