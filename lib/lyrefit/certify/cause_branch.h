#pragma once

#include <functional>
#include <memory>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// One diode, the terms of the data and one more cause: where its branch and bound ends.
struct CauseRegion {
  Window u;  // of the diode
  double rs_lower = 0;
  double rs_upper = 0;
};

struct CauseLimits {
  double relative_gap = 0.02;  // of half the sum of squares that is attained: settles a part
  double absolute_gap = 0;     // the same, as it is; the larger of both counts
  int most_solved = 2000;      // convex problems before giving up
  std::function<bool()> stop;  // true ends the work; may be empty
};

// A model within the region.
struct CausePoint {
  double rs = 0;
  double u = 0;  // of the diode
  double theta = 0;
  double primal = kInfinity;  // half the sum of squares
};

struct CauseEnd {
  CausePoint best;   // the lowest model met
  double lower = 0;  // proved for all models of the region, with any mixture over theta
  int solved = 0;
  bool complete = false;  // every part is settled
};

// The lowest half sum of squares of one diode beside the data's terms and `shape` (none: nothing
// more), of any strength. `start`: where a search for models begins, and what is known to be
// attained. Each part of the region is a range of Rs, a window of u and a span of theta, over which
// the cause may be a mixture.
CauseEnd BranchOverCause(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                         const CauseRegion& region, const CausePoint& start,
                         const CauseLimits& limits);

}  // namespace lyrefit
