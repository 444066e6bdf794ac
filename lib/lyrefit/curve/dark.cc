#include "lyrefit/curve/dark.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

constexpr double kLitFrom_W_m2 = 20;  // a sensor may show less in the dark

// Indices of the readings next to 0 V. `reverse_alone`: those of reverse bias if there are enough,
// where the current is nearly a line.
std::vector<int> NextToZero(const IvCurve& curve, std::size_t count, bool reverse_alone) {
  std::vector<int> all, reverse;
  for (int k = 0; k < static_cast<int>(curve.size()); ++k) {
    all.push_back(k);
    if (curve.voltage_V[k] <= 0) reverse.push_back(k);
  }
  std::vector<int>& from = reverse_alone && reverse.size() >= count ? reverse : all;
  std::stable_sort(from.begin(), from.end(), [&](int a, int b) {
    return std::fabs(curve.voltage_V[a]) < std::fabs(curve.voltage_V[b]);
  });
  from.resize(std::min(from.size(), count));
  return from;
}

// Whether the readings next to 0 V are of either sign by turns, as noise is. A photocurrent changes
// its sign once, at Voc.
bool AreNoise(const IvCurve& curve) {
  constexpr std::size_t kReadings = 15;
  constexpr int kFewestChanges = 3;
  std::vector<int> next = NextToZero(curve, kReadings, /*reverse_alone=*/false);
  std::stable_sort(next.begin(), next.end(),
                   [&](int a, int b) { return curve.voltage_V[a] < curve.voltage_V[b]; });
  int changes = 0;
  for (std::size_t k = 1; k < next.size(); ++k) {
    changes += (curve.current_A[next[k - 1]] > 0) != (curve.current_A[next[k]] > 0) ? 1 : 0;
  }
  return changes >= kFewestChanges;
}

// Smallest step between currents, which bounds the resolution of the instrument.
double SmallestStep(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double step = HUGE_VAL;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] > values[k - 1]) step = std::min(step, values[k] - values[k - 1]);
  }
  return step;
}

// Noise of the readings next to 0 V: the scatter about a line through them, at least the resolution.
// Infinite if they are too few to tell.
double NoiseNearZero(const IvCurve& curve) {
  constexpr std::size_t kReadings = 9;
  const std::vector<int> next = NextToZero(curve, kReadings, /*reverse_alone=*/true);
  if (next.size() < kReadings) return HUGE_VAL;
  double v = 0, i = 0, vv = 0, vi = 0;
  for (const int k : next) {
    v += curve.voltage_V[k] / kReadings;
    i += curve.current_A[k] / kReadings;
  }
  for (const int k : next) {
    vv += std::pow(curve.voltage_V[k] - v, 2);
    vi += (curve.voltage_V[k] - v) * (curve.current_A[k] - i);
  }
  const double slope = vv > 0 ? vi / vv : 0;
  std::vector<double> away;
  away.reserve(next.size());
  for (const int k : next) {
    away.push_back(curve.current_A[k] - i - slope * (curve.voltage_V[k] - v));
  }
  return std::max(RobustScale(std::move(away)), SmallestStep(curve.current_A));
}

}  // namespace

bool IsStatedDark(const IvCurve& curve) {
  return curve.irradiance_known && curve.conditions.irradiance_W_m2 <= 0;
}

bool IsNight(const IvCurve& curve) {
  if (!curve.irradiance_known || curve.conditions.irradiance_W_m2 > kLitFrom_W_m2) return false;
  // Of a thousand readings none exceeds 3.3 times their noise, which nine of them may show as a third.
  constexpr double kMost = 10;
  const double noise_A = NoiseNearZero(curve);
  return std::isfinite(noise_A) && LargestMagnitude(curve.current_A) <= kMost * noise_A;
}

bool IsDark(const IvCurve& curve) {
  constexpr double kOffset = 0.05, kNothing = 0.002;  // of the largest current
  constexpr double kNoises = 30, kNoisesAtLight = 5;
  if (curve.size() == 0) return false;
  if (IsNight(curve)) return true;
  const double at_zero_A = curve.current_A[NextToZero(curve, 1, /*reverse_alone=*/true).front()];
  const double largest_A = LargestMagnitude(curve.current_A);
  if (IsStatedDark(curve)) return at_zero_A <= kOffset * largest_A;
  if (!(at_zero_A > 0)) return true;
  const bool light = curve.irradiance_known && curve.conditions.irradiance_W_m2 > kLitFrom_W_m2;
  if (at_zero_A > kNothing * largest_A) {
    return !light && at_zero_A <= kOffset * largest_A && AreNoise(curve);
  }
  return at_zero_A <= (light ? kNoisesAtLight : kNoises) * NoiseNearZero(curve);
}

}  // namespace lyrefit
