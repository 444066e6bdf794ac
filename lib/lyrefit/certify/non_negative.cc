#include "lyrefit/certify/non_negative.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

// Least squares over the columns in `active`; zeros elsewhere.
Eigen::VectorXd SolveActive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                            const std::vector<int>& active) {
  Eigen::MatrixXd columns(a.rows(), active.size());
  for (std::size_t i = 0; i < active.size(); ++i) columns.col(i) = a.col(active[i]);
  const Eigen::VectorXd solution = LeastSquares(columns, b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  for (std::size_t i = 0; i < active.size(); ++i) x[active[i]] = solution[i];
  return x;
}

// The column outside `active` that the residual leans on most; -1: none beyond rounding.
int MostWanted(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& x,
               const std::vector<int>& active) {
  const Eigen::VectorXd y = Residual(b, a, x);
  int best = -1;
  double strongest = 1e-15 * b.norm();
  for (int i = 0; i < static_cast<int>(a.cols()); ++i) {
    if (std::find(active.begin(), active.end(), i) != active.end()) continue;
    const double pull = a.col(i).dot(y) / a.col(i).norm();
    if (pull <= strongest) continue;
    strongest = pull;
    best = i;
  }
  return best;
}

}  // namespace

Eigen::VectorXd SolveNonNegative(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                 Eigen::VectorXd x) {
  const int count = static_cast<int>(a.cols());
  std::vector<int> active(count);
  std::iota(active.begin(), active.end(), 0);
  for (int round = 0; round < 6 * count; ++round) {
    while (!active.empty()) {
      const Eigen::VectorXd target = SolveActive(a, b, active);
      double reach = 1;
      int blocking = -1;
      for (const int i : active) {
        if (target[i] > 0) continue;
        const double fraction = x[i] > 0 ? x[i] / (x[i] - target[i]) : 0;
        if (blocking >= 0 && fraction >= reach) continue;
        reach = fraction;
        blocking = i;
      }
      x += reach * (target - x);
      if (blocking < 0) break;
      x[blocking] = 0;
      active.erase(std::find(active.begin(), active.end(), blocking));
    }
    const int best = MostWanted(a, b, x, active);
    if (best < 0) break;
    active.push_back(best);
  }
  return x;
}

}  // namespace lyrefit
