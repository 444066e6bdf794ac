#include "lyrefit/curve/find_step.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewestPoints = 10;  // bins with readings
constexpr int kBins = 64;
constexpr double kDeep = 0.02;  // of the largest current
constexpr double kNoises = 6;

struct StepPoint {
  double voltage_V = 0;
  double current_A = 0;
};

double Median3(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Currents at forward voltage up to the last delivering voltage, as means over equal voltage bins.
// Binning merges sweeps up and down and repeated readings at one voltage.
std::vector<StepPoint> Binned(const IvCurve& curve) {
  double last_V = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.current_A[k] > 0) last_V = std::max(last_V, curve.voltage_V[k]);
  }
  struct VoltageBin {
    double voltage_V = 0, current_A = 0;
    int readings = 0;
  };
  std::vector<VoltageBin> bins(kBins);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double voltage_V = curve.voltage_V[k];
    if (voltage_V < 0 || voltage_V > last_V || !(last_V > 0)) continue;
    VoltageBin& bin = bins[std::min(static_cast<int>(voltage_V / last_V * kBins), kBins - 1)];
    bin.voltage_V += voltage_V;
    bin.current_A += curve.current_A[k];
    ++bin.readings;
  }
  std::vector<StepPoint> points;
  for (const VoltageBin& bin : bins) {
    if (bin.readings == 0) continue;
    points.push_back({bin.voltage_V / bin.readings, bin.current_A / bin.readings});
  }
  return points;
}

// Removes single outliers by a running median of three.
std::vector<StepPoint> Smooth(const std::vector<StepPoint>& points) {
  std::vector<StepPoint> smooth = points;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    smooth[k].current_A =
        Median3(points[k - 1].current_A, points[k].current_A, points[k + 1].current_A);
  }
  return smooth;
}

// Standard deviation of the noise from the median second difference, which knees and steps hardly
// affect.
double NoiseOf(const std::vector<StepPoint>& points) {
  std::vector<double> differences;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    differences.push_back(points[k - 1].current_A - 2 * points[k].current_A +
                          points[k + 1].current_A);
  }
  return RobustScale(std::move(differences), UpperMedian) / std::sqrt(6.0);
}

// Whether b lies on or below the line from a to c.
bool Below(const StepPoint& a, const StepPoint& b, const StepPoint& c) {
  return (b.current_A - a.current_A) * (c.voltage_V - a.voltage_V) <=
         (c.current_A - a.current_A) * (b.voltage_V - a.voltage_V);
}

std::vector<StepPoint> UpperHull(const std::vector<StepPoint>& points) {
  std::vector<StepPoint> hull;
  for (const StepPoint& point : points) {
    while (hull.size() > 1 && Below(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
  return hull;
}

}  // namespace

std::optional<CurveStep> FindStep(const IvCurve& curve) {
  const std::vector<StepPoint> binned = Binned(curve);
  if (binned.size() < kFewestPoints) return std::nullopt;
  const std::vector<StepPoint> points = Smooth(binned);
  const std::vector<StepPoint> hull = UpperHull(points);
  CurveStep step;
  double largest_A = 0;
  std::size_t right = 1;
  for (const StepPoint& point : points) {
    largest_A = std::max(largest_A, point.current_A);
    while (right + 1 < hull.size() && hull[right].voltage_V < point.voltage_V) ++right;
    const StepPoint& a = hull[right - 1];
    const StepPoint& b = hull[right];
    const double part = (point.voltage_V - a.voltage_V) / (b.voltage_V - a.voltage_V);
    const double depth_A = a.current_A + part * (b.current_A - a.current_A) - point.current_A;
    if (depth_A > step.depth_A) step = {point.voltage_V, depth_A};
  }
  if (step.depth_A <= kDeep * largest_A || step.depth_A <= kNoises * NoiseOf(binned)) {
    return std::nullopt;
  }
  return step;
}

}  // namespace lyrefit
