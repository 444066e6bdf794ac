#pragma once

#include <vector>

#include "faults/random.h"

namespace faults::field {

enum class Cloud { kNone, kStep, kDip, kDrift, kEdge };

// Irradiance on the whole module during the sweep, relative to its nominal value. Times run from 0
// to 1 over the measurement.
struct Sky {
  Cloud cloud = Cloud::kNone;
  double size = 0;     // of a step or edge, of a dip (loss), or of a drift from beginning to end
  double at = 0.5;     // time of the step; centre of the dip or the edge
  double width = 0.1;  // of a dip; of an edge, from begin to end
  double skew = 0;  // dip: asymmetry, a positive value falls faster than it rises; drift: curvature
  std::vector<double> wander;  // relative, at equal times from 0 to 1; empty: none

  double Light(double time) const;           // step, edge, dip or drift only
  double WanderingLight(double time) const;  // with the random fluctuation as well
};

// Random fluctuation with relative standard deviation `size`. It is one of three types, drawn at
// random: autoregressive (AR(1)), random walk or sum of sines.
std::vector<double> DrawWander(double size, Random* random);

}  // namespace faults::field
