#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lyrefit/certify/relaxation.h"

namespace lyrefit {

// Where a branch and bound over Rs (and, for a fixed number of diodes, over windows of u) ended.
// `primal` and `lower` are half sums of squares.
struct BranchEnd {
  Mixture best;             // the lowest mixture met that counts
  double lower = 0;         // proved lower bound of everything in the region
  std::int64_t solved = 0;  // mixtures solved
  bool complete = false;    // every part of the region is settled to the tolerance
  double rs_reached = 0;    // largest Rs of a mixture solved
};

struct BranchLimits {
  double rs_lower = 0;
  double rs_upper = 0;  // may be infinite where `rs_cut` is not
  // From here on the order of the points may prove enough: larger Rs are divided only where it does
  // not.
  double rs_cut = kInfinity;
  double rs_divided = kInfinity;  // beyond this the order has to do: parts of that are settled
  double tolerance = 1e-10;       // relative gap of the sums of squares that settles a part
  bool rigorous = false;          // the lower bound holds in spite of rounding
  int most_solved = 20000;        // mixtures solved before giving up
  // Asked now and then with the count of mixtures solved, the best half sum of squares and the
  // lower bound proved so far; false ends the work. May be empty.
  std::function<bool(std::int64_t, double, double)> proceed;
  // See Incumbent.
  std::function<double(const Mixture&)> polish;
};

// The lowest value of a model with a diode in each window of the box and Rs in the limits. Each part
// of the region holds a window of u per diode and is bounded from below by any mixture over these
// windows. `primal` is what is known to be reached; parts that cannot go below it are settled.
BranchEnd BranchOver(const Relaxation& relaxation, const std::vector<Window>& box, double primal,
                     const BranchLimits& limits);
// The same of at most `diodes` diodes (0: of any number) in one window.
BranchEnd BranchOver(const Relaxation& relaxation, const Window& window, int diodes, double primal,
                     const BranchLimits& limits);

// The same for the problem of mixture.h.
BranchEnd BranchOverResistance(const MixtureData& data, const Window& window,
                               const BranchLimits& limits);
BranchEnd BranchOverDiodes(const MixtureData& data, const std::vector<Window>& box, double primal,
                           const BranchLimits& limits);
BranchEnd BranchOverDiodes(const MixtureData& data, const Window& window, int diodes, double primal,
                           const BranchLimits& limits);

}  // namespace lyrefit
