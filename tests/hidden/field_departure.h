#pragma once

#include <vector>

#include "hidden/random.h"

namespace hidden::field {

// How far a module departs from any curve its cells would make, in parts of its short-circuit
// current: a rough path over the voltage, smooth bumps, and a knee sharper or rounder than diodes'.
struct Departure {
  struct Bump {
    double at, width, size;
  };
  double size = 0;           // factor on everything
  std::vector<double> path;  // over u = 0 .. kFarthest, equal steps
  std::vector<Bump> bumps;
  double flat = 1;  // what of both is left far below the knee, where modules keep closer to diodes
  double knee = 0;
  double knee_exponent = 1;

  // `u`: voltage / open circuit; `lost`: part of the short-circuit current not delivered there.
  double At(double u, double lost) const;
};

Departure DrawDeparture(Random* random);

}  // namespace hidden::field
