#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// The middle value, or the mean of the two middle values for an even number; NaN for an empty
// vector.
inline double Median(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// The upper median: always one of the values, the larger of the two middle ones for an even number.
// NaN for an empty vector.
inline double UpperMedian(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lyrefit
