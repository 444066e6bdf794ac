#include "lyrefit/estimate/fit/distinct_readings.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "lyrefit/curve/keep_readings.h"

namespace lyrefit {
DistinctReadings FindDistinctReadings(const IvCurve& curve) {
  const auto at = [](const std::vector<double>& column, int k) {
    return column.empty() ? 0 : column[k];
  };
  const auto key = [&](int k) {
    return std::make_tuple(curve.voltage_V[k], curve.current_A[k], at(curve.sigma_A, k),
                           at(curve.time_s, k));
  };
  const int readings = static_cast<int>(curve.size());
  std::vector<int> order(readings);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<double> copies(readings, 0);
  int first = 0, distinct = 0;
  for (int k = 0; k < readings; ++k) {
    if (k == 0 || key(order[k]) != key(first)) {
      first = order[k];
      ++distinct;
    }
    ++copies[first];
  }
  DistinctReadings found{curve, {}};
  if (distinct == readings) return found;
  std::vector<int> kept;
  for (int k = 0; k < readings; ++k) {
    if (copies[k] > 0) kept.push_back(k);
  }
  KeepValues(kept, &copies);
  found.copies = std::move(copies);
  KeepReadings(kept, &found.curve);
  return found;
}

}  // namespace lyrefit
