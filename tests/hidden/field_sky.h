#pragma once

#include <vector>

#include "hidden/random.h"

namespace hidden::field {

enum class Cloud { kNone, kStep, kDip, kDrift };

// The light on the whole module while the sweep runs, 1 on the whole. Times run from 0 to 1 over
// the measurement.
struct Sky {
  Cloud cloud = Cloud::kNone;
  double size = 0;     // of a step, a dip (taken away) or a drift from beginning to end
  double at = 0.5;     // when; of a dip its middle
  double width = 0.1;  // of a dip
  double skew = 0;     // of a dip: how much sooner it comes than it goes; of a drift: its bend
  std::vector<double> wander;  // relative, at equal times from 0 to 1; empty: none

  double Light(double time) const;           // with the cloud
  double WanderingLight(double time) const;  // and with what wanders
};

// A path with a relative standard deviation of `size`, of one of three kinds: it forgets at random,
// it never forgets, or it swings.
std::vector<double> DrawWander(double size, Random* random);

}  // namespace hidden::field
