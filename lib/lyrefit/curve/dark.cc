#include "lyrefit/curve/dark.h"

#include <cmath>

#include "lyrefit/base/largest.h"

namespace lyrefit {
namespace {

// Current at the reading with the smallest |V|.
double CurrentNearZero(const IvCurve& curve) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    if (std::fabs(curve.voltage_V[k]) < std::fabs(curve.voltage_V[nearest])) nearest = k;
  }
  return curve.current_A[nearest];
}

}  // namespace

bool IsStatedDark(const IvCurve& curve) {
  return curve.irradiance_known && curve.conditions.irradiance_W_m2 <= 0;
}

bool IsDark(const IvCurve& curve) {
  constexpr double kOffset = 0.05, kNothing = 0.002;  // of the largest current
  if (curve.size() == 0) return false;
  const double least = IsStatedDark(curve) ? kOffset : kNothing;
  return CurrentNearZero(curve) <= least * LargestMagnitude(curve.current_A);
}

}  // namespace lyrefit
