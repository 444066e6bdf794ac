#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace lyrefit {

// The largest |value|; 0 of none. Passes over what is not a number.
inline double LargestMagnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  return largest;
}

}  // namespace lyrefit
