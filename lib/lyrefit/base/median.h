#pragma once
// Order statistics, and statistics that outliers hardly affect.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
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

// Ratio of the standard deviation to the median of |x|, for a normal x, and the efficiency of that
// estimate.
inline constexpr double kMedianToSigma = 1.4826;
inline constexpr double kMadEfficiency = 0.37;

// Standard deviation of normal values about 0: 1.4826 x median of |values|, NaN for an empty vector.
inline double RobustScale(std::vector<double> values,
                          double (*median)(std::vector<double>) = Median) {
  for (double& value : values) value = std::fabs(value);
  return kMedianToSigma * median(std::move(values));
}

// Huber's weight of a residual of absolute value `size`: residuals beyond `limit` count less.
inline double HuberWeight(double size, double limit) { return size > limit ? limit / size : 1; }

// The value below which a share of the sorted values lies, interpolated linearly between them. There
// must be one at least.
inline double Quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

// The largest absolute value; 0 for an empty vector. NaN is ignored.
inline double LargestMagnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  return largest;
}

}  // namespace lyrefit
