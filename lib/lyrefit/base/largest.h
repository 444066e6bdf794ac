#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace lyrefit {

// The largest absolute value; 0 for an empty vector. NaN is ignored.
inline double LargestMagnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  return largest;
}

}  // namespace lyrefit
