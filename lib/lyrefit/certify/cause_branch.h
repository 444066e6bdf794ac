#pragma once

#include <memory>

#include "lyrefit/base/observer.h"
#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// Region of a branch and bound for a model of one diode, the linear terms of the data and one more
// cause. A cause is a current that is linear in its strength (cause_shape.h). Resistances are in
// ohm.
struct CauseRegion {
  Window u;  // of the diode: u = 1 / (n Ns Vt) in 1/V
  double rs_lower = 0;
  double rs_upper = 0;
};

struct CauseLimits {
  double relative_gap = 0.02;  // closes a part: fraction of the half sum of squares reached
  double absolute_gap = 0;     // closes a part: absolute; the larger of both gaps applies
  int most_solved = 2000;      // convex problems solved before giving up
  StopToken stop;              // polled before each split; a stop ends the search
};

// A model within the region: Rs in ohm, u in 1/V, and the parameter theta of the cause.
struct CausePoint {
  double rs = 0;
  double u = 0;  // of the diode
  double theta = 0;
  double primal = kInfinity;  // half the sum of squares
};

struct CauseEnd {
  CausePoint best;   // the lowest model found
  double lower = 0;  // proved for all models of the region, with any mixture over theta
  int solved = 0;
  bool complete = false;  // every part meets the gap
};

// Bounds the lowest half sum of squares of one diode with the data's terms and `shape` at any
// strength; a null shape adds nothing. The search for models begins at `start`, whose value is
// known to be reached. Each part of the region is a range of Rs, a window of u and a span of theta.
// Within a span the cause may be a mixture over theta.
CauseEnd BranchOverCause(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                         const CauseRegion& region, const CausePoint& start,
                         const CauseLimits& limits);

}  // namespace lyrefit
