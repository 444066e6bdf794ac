#pragma once

#include <vector>

#include "faults/random.h"

namespace faults::field {

// Deviation of a module from the curve of its cells, as a fraction of Isc. It sums a rough path
// over the voltage, smooth bumps, and a knee that is sharper or rounder than that of diodes.
struct Departure {
  struct Bump {
    double at, width, size;
  };
  double size = 0;           // factor on the sum
  std::vector<double> path;  // at equal steps of u = 0 .. kFarthest
  std::vector<Bump> bumps;
  double flat = 1;  // factor on path and bumps far below the knee, where modules follow diodes more
                    // closely
  double knee = 0;
  double knee_exponent = 1;

  // `u`: voltage / open-circuit voltage. `lost`: 1 - current / Isc at that voltage.
  double At(double u, double lost) const;
};

Departure DrawDeparture(Random* random);

}  // namespace faults::field
