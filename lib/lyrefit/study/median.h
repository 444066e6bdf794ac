#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace lyrefit {

// The middle value, or the mean of the two in the middle; NaN of none.
inline double MedianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace lyrefit
