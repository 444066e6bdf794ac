#include "lyrefit/curve/key_points.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lyrefit {
namespace {

constexpr double kFarthest = 0.05;  // largest extrapolation, as a fraction of the curve's own range

struct Point {
  double voltage_V;
  double current_A;

  double power_W() const { return voltage_V * current_A; }
};

// Points by rising voltage; readings at one voltage are replaced by their mean.
std::vector<Point> SortAndMerge(const std::vector<double>& voltage_V,
                                const std::vector<double>& current_A) {
  std::vector<Point> points(voltage_V.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {voltage_V[i], current_A[i]};
  const auto lower = [](const Point& a, const Point& b) { return a.voltage_V < b.voltage_V; };
  if (!std::is_sorted(points.begin(), points.end(), lower)) {
    std::stable_sort(points.begin(), points.end(), lower);
  }
  std::vector<Point> merged;
  merged.reserve(points.size());
  for (std::size_t i = 0; i < points.size();) {
    double sum = 0;
    std::size_t end = i;
    for (; end < points.size() && points[end].voltage_V == points[i].voltage_V; ++end) {
      sum += points[end].current_A;
    }
    merged.push_back({points[i].voltage_V, sum / static_cast<double>(end - i)});
    i = end;
  }
  return merged;
}

double CurrentAt(double voltage_V, const Point& a, const Point& b) {
  const double part = (voltage_V - a.voltage_V) / (b.voltage_V - a.voltage_V);
  return a.current_A + part * (b.current_A - a.current_A);
}

// The nearest point to `last` in direction `step` that is at least 1 % of the voltage range away.
// The slope between closer points of a dense curve would be noise.
const Point& Partner(const std::vector<Point>& points, std::size_t last, int step) {
  const double range = points.back().voltage_V - points.front().voltage_V;
  std::size_t at = last + step;
  while (std::abs(points[at].voltage_V - points[last].voltage_V) < 0.01 * range) at += step;
  return points[at];
}

double ShortCircuitCurrent(const std::vector<Point>& points) {
  const std::size_t last = points.size() - 1;
  const double range = points[last].voltage_V - points[0].voltage_V;
  if (points[0].voltage_V > 0) {
    if (points[0].voltage_V > kFarthest * range) return kUnknown;
    return CurrentAt(0, points[0], Partner(points, 0, 1));
  }
  if (points[last].voltage_V < 0) {
    if (-points[last].voltage_V > kFarthest * range) return kUnknown;
    return CurrentAt(0, points[last], Partner(points, last, -1));
  }
  const auto above = std::find_if(points.begin(), points.end(),
                                  [](const Point& point) { return point.voltage_V >= 0; });
  if (above->voltage_V == 0) return above->current_A;
  return CurrentAt(0, *(above - 1), *above);
}

double OpenCircuitVoltage(const std::vector<Point>& points) {
  // Noise may cause several crossings; the one at the highest voltage is used.
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    const Point& a = points[i - 1];
    const Point& b = points[i];
    if (b.current_A == 0) return b.voltage_V;
    if (!(a.current_A >= 0 && b.current_A < 0)) continue;
    return a.voltage_V + a.current_A / (a.current_A - b.current_A) * (b.voltage_V - a.voltage_V);
  }
  if (points[0].current_A == 0) return points[0].voltage_V;

  const Point& before = Partner(points, points.size() - 1, -1);
  const Point& last = points.back();
  double largest = last.current_A;
  for (const Point& point : points) largest = std::max(largest, point.current_A);
  const bool near = last.current_A > 0 &&
                    last.current_A <= kFarthest * (largest - last.current_A) &&
                    last.current_A < before.current_A;
  if (!near) return kUnknown;
  const double beyond =
      last.current_A / (before.current_A - last.current_A) * (last.voltage_V - before.voltage_V);
  // Two noisy points may be almost parallel to the axis, which makes the extrapolation unreliable.
  const double range = last.voltage_V - points[0].voltage_V;
  return beyond <= kFarthest * range ? last.voltage_V + beyond : kUnknown;
}

// Vertex of the parabola of power over voltage through three points, of which the middle one is
// highest. Returns the middle point if uneven spacing lets noise raise the vertex far above the
// readings.
Point TopOfParabola(const Point& left, const Point& best, const Point& right) {
  const double to_left = left.voltage_V - best.voltage_V;
  const double to_right = right.voltage_V - best.voltage_V;
  const double drop_left = left.power_W() - best.power_W();
  const double drop_right = right.power_W() - best.power_W();
  // P - Pbest = slope u + bend u^2 with u = V - Vbest.
  const double bend = (drop_right / to_right - drop_left / to_left) / (to_right - to_left);
  const double slope = drop_right / to_right - bend * to_right;
  if (!(bend < 0)) return best;
  const double voltage_V = best.voltage_V - slope / (2 * bend);
  const double rise = -slope * slope / (4 * bend);
  if (!(rise <= 0.5 * std::max(-drop_left, -drop_right)) || voltage_V == 0) return best;
  return {voltage_V, (best.power_W() + rise) / voltage_V};
}

}  // namespace

KeyPoints FindKeyPoints(const std::vector<double>& voltage_V,
                        const std::vector<double>& current_A) {
  CHECK_EQ(voltage_V.size(), current_A.size());
  KeyPoints key{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  const std::vector<Point> points = SortAndMerge(voltage_V, current_A);
  if (points.size() < 2) return key;
  key.short_circuit_current_A = ShortCircuitCurrent(points);
  key.open_circuit_voltage_V = OpenCircuitVoltage(points);

  std::size_t best = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].voltage_V <= 0 || points[i].current_A <= 0) continue;
    if (best == points.size() || points[i].power_W() > points[best].power_W()) best = i;
  }
  if (best == points.size()) return key;
  Point top = points[best];
  if (best > 0 && best + 1 < points.size()) {
    top = TopOfParabola(points[best - 1], points[best], points[best + 1]);
  }
  key.max_power_voltage_V = top.voltage_V;
  key.max_power_current_A = top.current_A;
  key.max_power_W = top.power_W();
  const double ideal_W = key.short_circuit_current_A * key.open_circuit_voltage_V;
  if (ideal_W > 0) key.fill_factor = key.max_power_W / ideal_W;
  return key;
}

double GreenFillFactor(double voc_V, double nNsVth) {
  const double v = voc_V / nNsVth;
  return (v - std::log(v + 0.72)) / (v + 1);
}

}  // namespace lyrefit
