#pragma once

#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/part_bound.h"

namespace lyrefit {

// Upper bounds of the gain of all causes (cause_shape.h) among the data's terms along the dual
// vectors of two solutions `a` and `b`. The gain is the largest strength that the dual gain allows
// times the pull of the column.
struct CauseGain {
  double at_a = 0;
  double at_b = 0;
  // Between the two solutions the gain exceeds its interpolation by at most t (1 - t) / 2 times
  // this.
  double bend = 0;
};
CauseGain CauseDualGains(const MixtureData& data, const Mixture& a, const Mixture& b,
                         const DualGain& dual_gain);

}  // namespace lyrefit
