#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lyrefit {

// The value below which a share of the sorted values lies, interpolated linearly between them. There
// must be one at least.
inline double Quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace lyrefit
