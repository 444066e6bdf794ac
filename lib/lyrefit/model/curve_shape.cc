#include "lyrefit/model/curve_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lyrefit {
namespace {

constexpr int kSteps = 200;

using Points = std::vector<std::pair<double, double>>;  // voltage (rising) and current

// Running median of five currents.
Points Medians(const Points& points) {
  Points smooth = points;
  const int count = static_cast<int>(points.size());
  for (int k = 0; k < count; ++k) {
    const int reach = std::min({2, k, count - 1 - k});
    std::vector<double> around;
    for (int i = k - reach; i <= k + reach; ++i) around.push_back(points[i].second);
    std::nth_element(around.begin(), around.begin() + reach, around.end());
    smooth[k].second = around[reach];
  }
  return smooth;
}

double Interpolate(const Points& points, double voltage) {
  const auto above = std::lower_bound(points.begin(), points.end(), std::pair{voltage, -1e300});
  if (above == points.begin()) return points.front().second;
  if (above == points.end()) return points.back().second;
  const auto below = above - 1;
  const double span = above->first - below->first;
  const double part = span > 0 ? (voltage - below->first) / span : 0;
  return below->second + part * (above->second - below->second);
}

}  // namespace

double CurveShape::At(double part) const {
  if (current.empty()) return 0;
  const double last = static_cast<double>(current.size() - 1);
  const double at = std::clamp(part, 0.0, 1.0) * last;
  const std::size_t below = static_cast<std::size_t>(std::min(at, last - 1));
  return current[below] + (at - static_cast<double>(below)) * (current[below + 1] - current[below]);
}

CurveShape ShapeOf(const Readings& readings) {
  CurveShape shape;
  Points points;
  for (const Reading& r : readings.points) {
    if (!r.dark) points.push_back({r.voltage, r.current});
  }
  if (points.size() < 2) return shape;
  std::sort(points.begin(), points.end());
  shape.open_circuit = readings.pivot_voltage;
  const Points smooth = Medians(points);
  for (int k = 0; k <= kSteps; ++k) {
    shape.current.push_back(Interpolate(smooth, shape.open_circuit * k / kSteps));
  }
  return shape;
}

}  // namespace lyrefit
