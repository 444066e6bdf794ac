#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lyrefit/certify/relaxation.h"

namespace lyrefit {

// Result of a branch and bound over Rs (ohm) and, for a fixed number of diodes, over windows of
// u = 1 / (n Ns Vt). `primal` and `lower` are half sums of squares.
struct BranchEnd {
  Mixture best;             // lowest mixture found that meets the diode count and ranges
  double lower = 0;         // proved lower bound over the whole region
  std::int64_t solved = 0;  // number of convex problems solved
  bool complete = false;    // true: `lower` meets the tolerance
  double rs_reached = 0;    // largest Rs of a part that was searched
};

// Limits of a branch and bound; resistances in ohm.
struct BranchLimits {
  double rs_lower = 0;
  double rs_upper = 0;  // may be infinite if `rs_cut` is finite
  // From this Rs on, the order of the points may prove the bound (relaxation.h). Larger Rs are
  // divided only where it does not.
  double rs_cut = kInfinity;
  double rs_divided = kInfinity;  // larger Rs are not divided; they keep their tail bound
  double tolerance = 1e-10;       // relative gap of the sums of squares that closes a part
  bool rigorous = false;          // true: rounding cannot raise `lower` above the truth
  int most_solved = 20000;        // convex problems solved before giving up
  // Called before each split with the number of convex problems solved, the lowest half sum of
  // squares found and the lower bound proved so far. Returning true ends the search. May be empty.
  std::function<bool(std::int64_t, double, double)> stop;
  // Refines a mixture to a model; see Incumbent::polish in relaxation.h.
  std::function<double(const Mixture&)> polish;
};

// Bounds the lowest half sum of squares of a model with one diode in each window of `box` and Rs in
// the limits. Each part of the region has one window of u per diode. Its lower bound is that of any
// mixture over these windows. `primal` is a value known to be reached; parts that cannot go below
// it are closed.
BranchEnd BranchOver(const Relaxation& relaxation, const std::vector<Window>& box, double primal,
                     const BranchLimits& limits);
// Bounds models of at most `diodes` diodes in one window; 0 means any number of diodes.
BranchEnd BranchOver(const Relaxation& relaxation, const Window& window, int diodes, double primal,
                     const BranchLimits& limits);

}  // namespace lyrefit
