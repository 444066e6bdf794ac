#pragma once

#include <cmath>
#include <cstddef>

namespace lyrefit {

// Ceres writes to the log if it receives a number that is not finite; this check comes before.
inline bool AllFinite(const double* x, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    if (!std::isfinite(x[k])) return false;
  }
  return true;
}

}  // namespace lyrefit
