#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// Where a branch and bound over Rs (and, for a fixed number of diodes, over windows of u) ended.
// `primal` and `lower` are half sums of squares.
struct BranchEnd {
  Mixture best;           // the lowest mixture met that counts
  double lower = 0;       // proved lower bound of everything in the region
  int solved = 0;         // mixtures solved
  bool complete = false;  // every part of the region is settled to the tolerance
};

struct BranchLimits {
  double rs_lower = 0;
  double rs_upper = 0;
  double tolerance = 1e-10;  // relative gap of the sums of squares that settles a part
  int most_solved = 20000;   // mixtures solved before giving up
  // Asked now and then with the count of mixtures solved, the best half sum of squares and the
  // lower bound proved so far; false ends the work. May be empty.
  std::function<bool(std::int64_t, double, double)> proceed;
};

// The lowest mixture with any number of diodes over Rs in the limits. Between two neighbouring Rs
// the dual vectors of both ends, interpolated, prove a lower bound for every Rs between them:
// feasible up to second order in the distance, and what is lacking is priced.
BranchEnd BranchOverResistance(const MixtureData& data, const Window& window,
                               const BranchLimits& limits);

// The lowest model with at most `diodes` diodes. Each part of the region holds a window of u per
// diode and is bounded from below by any mixture over these windows. `primal` is what a model with
// so many diodes is known to reach; parts that cannot go below it are settled.
BranchEnd BranchOverDiodes(const MixtureData& data, const Window& window, int diodes, double primal,
                           const BranchLimits& limits);

}  // namespace lyrefit
