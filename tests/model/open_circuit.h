#pragma once

#include "lyrefit/model/device.h"

namespace lyrefit {

// Junction voltage without current, by bisection in double precision.
inline double OpenCircuit(const Device& device, const double* p) {
  double low = 0, high = 1;
  while (JunctionCurrent(device, p, high) > 0) high *= 2;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (JunctionCurrent(device, p, middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace lyrefit
