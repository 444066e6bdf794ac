#include "lyrefit/model/curve_shape.h"

#include <algorithm>
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

Stairs StairsOf(const CurveShape& shape) {
  constexpr int kReach = 3;  // steps to either side over which a slope is taken
  constexpr double kTwice = 1.5, kLeast = 0.004;  // contrast of a step and its plateau
  Stairs stairs;
  if (shape.current.empty()) return stairs;
  const auto slope = [&](int k) { return shape.current[k - kReach] - shape.current[k + kReach]; };
  int flattest = kReach, steepest = kReach;
  bool rising = true;  // the slope is about to rise from a plateau to a step
  for (int k = kReach; k <= kSteps - kReach; ++k) {
    if (rising && slope(k) < slope(flattest)) flattest = k;
    if (!rising && slope(k) > slope(steepest)) steepest = k;
    if (rising && slope(k) > kTwice * std::max(slope(flattest), 0.0) + kLeast) {
      stairs.plateaus.push_back({static_cast<double>(flattest) / kSteps, shape.current[flattest]});
      rising = false;
      steepest = k;
    } else if (!rising && kTwice * std::max(slope(k), 0.0) + kLeast < slope(steepest)) {
      stairs.steps.push_back(static_cast<double>(steepest) / kSteps);
      rising = true;
      flattest = k;
    }
  }
  if (!rising) stairs.steps.push_back(static_cast<double>(steepest) / kSteps);
  return stairs;
}

CurveShape ShapeOf(const Readings& readings) {
  CurveShape shape;
  Points points;
  for (const Reading& r : readings.points) {
    if (!r.dark && !r.suns_voc) points.push_back({r.voltage, r.current});
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
