#include "lyrefit/refine/bounded_linear.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

namespace lyrefit {
namespace {

enum class Side { kFree, kLower, kUpper };

// Least squares in the free variables with the others where they are.
Eigen::VectorXd SolveFree(const Eigen::MatrixXd& gram, const Eigen::VectorXd& atb,
                          const Eigen::VectorXd& x, const std::vector<int>& free) {
  const int count = static_cast<int>(free.size());
  Eigen::MatrixXd g(count, count);
  Eigen::VectorXd rhs(count);
  Eigen::VectorXd rest = x;
  for (const int i : free) rest[i] = 0;
  const Eigen::VectorXd shifted = atb - gram * rest;
  for (int a = 0; a < count; ++a) {
    rhs[a] = shifted[free[a]];
    for (int b = 0; b < count; ++b) g(a, b) = gram(free[a], free[b]);
  }
  return g.ldlt().solve(rhs);
}

// Goes from x towards the free solution; at the first bound on the way, stops there and clamps.
// True if the whole way was free.
bool StepTowards(const Eigen::VectorXd& target, const std::vector<int>& free,
                 const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, Eigen::VectorXd* x,
                 std::vector<Side>* side) {
  double reach = 1;
  int first = -1;
  for (std::size_t a = 0; a < free.size(); ++a) {
    const int i = free[a];
    const double step = target[a] - (*x)[i];
    if (!(target[a] < lower[i] || target[a] > upper[i])) continue;
    const double fraction = ((step < 0 ? lower[i] : upper[i]) - (*x)[i]) / step;
    if (first >= 0 && fraction >= reach) continue;
    reach = fraction;
    first = i;
  }
  for (std::size_t a = 0; a < free.size(); ++a) {
    const int i = free[a];
    (*x)[i] += reach * (target[a] - (*x)[i]);
    if (i != first) continue;
    const bool down = target[a] < lower[i];
    (*x)[i] = down ? lower[i] : upper[i];
    (*side)[i] = down ? Side::kLower : Side::kUpper;
  }
  return first < 0;
}

}  // namespace

Eigen::VectorXd SolveBoundedLinear(const Eigen::MatrixXd& gram, const Eigen::VectorXd& atb,
                                   const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const int count = static_cast<int>(atb.size());
  Eigen::VectorXd x = lower;
  std::vector<Side> side(count, Side::kLower);
  for (int round = 0; round < 10 * count; ++round) {
    const Eigen::VectorXd pull = atb - gram * x;
    int best = -1;
    double strongest = 1e-12;
    for (int i = 0; i < count; ++i) {
      if (side[i] == Side::kFree || !(lower[i] < upper[i])) continue;
      const double scale = std::sqrt(gram(i, i));
      const double inward = (side[i] == Side::kLower ? pull[i] : -pull[i]) / (scale > 0 ? scale : 1);
      if (inward <= strongest) continue;
      strongest = inward;
      best = i;
    }
    if (best < 0) break;
    side[best] = Side::kFree;
    for (int inner = 0; inner <= count; ++inner) {
      std::vector<int> free;
      for (int i = 0; i < count; ++i) {
        if (side[i] == Side::kFree) free.push_back(i);
      }
      if (free.empty()) break;
      const Eigen::VectorXd target = SolveFree(gram, atb, x, free);
      if (!target.allFinite()) return x;
      if (StepTowards(target, free, lower, upper, &x, &side)) break;
    }
  }
  return x;
}

}  // namespace lyrefit
