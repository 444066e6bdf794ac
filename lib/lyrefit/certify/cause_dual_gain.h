#pragma once

#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/part_bound.h"

namespace lyrefit {

// What all causes among the terms of the data may gain along the dual vectors of two solutions, as
// much as their strengths can be at the dual gain.
struct CauseGain {
  double at_a = 0;
  double at_b = 0;
  // Between the two, t (1 - t) / 2 times this beyond what is interpolated.
  double bend = 0;
};
CauseGain CauseDualGains(const MixtureData& data, const Mixture& a, const Mixture& b,
                      const DualGain& dual_gain);

}  // namespace lyrefit
