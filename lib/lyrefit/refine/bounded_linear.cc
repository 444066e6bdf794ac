#include "lyrefit/refine/bounded_linear.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

enum class Held { kFree, kLower, kUpper };

// The unknowns that are not at a bound.
struct FreeSet {
  int count = 0;
  int index[kMostLinear];
  void Add(int i) { index[count++] = i; }
};

// Least squares in the free variables, the others fixed at `x`.
SmallVector SolveFree(const SmallMatrix& gram, const SmallVector& atb, const SmallVector& x,
                      const FreeSet& free) {
  const int count = free.count;
  SmallMatrix g(count, count);
  SmallVector rhs(count);
  SmallVector rest = x;
  for (int a = 0; a < count; ++a) rest[free.index[a]] = 0;
  const SmallVector shifted = atb - gram * rest;
  for (int a = 0; a < count; ++a) {
    rhs[a] = shifted[free.index[a]];
    for (int b = 0; b < count; ++b) g(a, b) = gram(free.index[a], free.index[b]);
  }
  return g.ldlt().solve(rhs);
}

// Steps from x to the free solution; stops at the first bound on the way and fixes that variable.
// True if no bound was met.
bool StepTowards(const SmallVector& target, const FreeSet& free, const SmallVector& lower,
                 const SmallVector& upper, SmallVector* x, Held* side) {
  double reach = 1;
  int first = -1;
  for (int a = 0; a < free.count; ++a) {
    const int i = free.index[a];
    const double step = target[a] - (*x)[i];
    if (!(target[a] < lower[i] || target[a] > upper[i])) continue;
    const double fraction = ((step < 0 ? lower[i] : upper[i]) - (*x)[i]) / step;
    if (first >= 0 && fraction >= reach) continue;
    reach = fraction;
    first = i;
  }
  for (int a = 0; a < free.count; ++a) {
    const int i = free.index[a];
    (*x)[i] += reach * (target[a] - (*x)[i]);
    if (i != first) continue;
    const bool down = target[a] < lower[i];
    (*x)[i] = down ? lower[i] : upper[i];
    side[i] = down ? Held::kLower : Held::kUpper;
  }
  return first < 0;
}

}  // namespace

SmallVector SolveBoundedLinear(const SmallMatrix& gram, const SmallVector& atb,
                               const SmallVector& lower, const SmallVector& upper) {
  const int count = static_cast<int>(atb.size());
  SmallVector x = lower;
  Held side[kMostLinear];
  std::fill(side, side + count, Held::kLower);
  for (int round = 0; round < 10 * count; ++round) {
    const SmallVector pull = atb - gram * x;
    int best = -1;
    double strongest = 1e-12;
    for (int i = 0; i < count; ++i) {
      if (side[i] == Held::kFree || !(lower[i] < upper[i])) continue;
      const double scale = std::sqrt(gram(i, i));
      const double inward =
          (side[i] == Held::kLower ? pull[i] : -pull[i]) / (scale > 0 ? scale : 1);
      if (inward <= strongest) continue;
      strongest = inward;
      best = i;
    }
    if (best < 0) break;
    side[best] = Held::kFree;
    for (int inner = 0; inner <= count; ++inner) {
      FreeSet free;
      for (int i = 0; i < count; ++i) {
        if (side[i] == Held::kFree) free.Add(i);
      }
      if (free.count == 0) break;
      const SmallVector target = SolveFree(gram, atb, x, free);
      if (!target.allFinite()) return x;
      if (StepTowards(target, free, lower, upper, &x, side)) break;
    }
  }
  return x;
}

}  // namespace lyrefit
