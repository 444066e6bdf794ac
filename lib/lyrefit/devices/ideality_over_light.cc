#include "lyrefit/devices/cell_figures.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/devices/line.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

// Logarithms of the light, and the voltages.
Line LogLine(const std::vector<VocPoint>& points) {
  Line line;
  for (const VocPoint& point : points) {
    line.x.push_back(std::log(point.light_A));
    line.y.push_back(point.voc_V);
  }
  return line;
}

// Whether the local n is higher below than above by more than `least` (relative): the mean of the
// lower third against that of the upper third.
bool RisesToLowLight(const std::vector<LocalIdeality>& local) {
  constexpr double kLeast = 0.1;
  const std::size_t third = std::max<std::size_t>(1, local.size() / 3);
  if (local.size() < 2) return false;
  double low = 0, high = 0;
  for (std::size_t k = 0; k < third; ++k) {
    low += local[k].n;
    high += local[local.size() - 1 - k].n;
  }
  return low > (1 + kLeast) * high;
}

// Slope -dI/dV of the readings with |V| <= reach, of at least the three nearest to 0 V.
double SlopeNearZero(const CellSweep& dark, double reach) {
  const auto [first, last] = NearZero(dark.voltage_V, reach);
  return -Regress(dark.voltage_V, dark.current_A, first, last).slope;
}

// One point a light, the mean of its lit sweeps.
std::vector<VocPoint> PointsOfAll(const std::vector<CellSweep>& sweeps) {
  constexpr double kSameLight = 0.02;
  std::vector<VocPoint> points;
  std::vector<bool> taken(sweeps.size(), false);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    VocPoint sum = {0, 0};
    double count = 0;
    for (std::size_t j = i; j < sweeps.size(); ++j) {
      const double light = sweeps[i].irradiance_W_m2;
      if (taken[j] || sweeps[j].kind != SweepKind::kLit || sweeps[i].kind != SweepKind::kLit ||
          std::fabs(sweeps[j].irradiance_W_m2 - light) > kSameLight * light) {
        continue;
      }
      taken[j] = true;
      const KeyPoints& key = sweeps[j].key;
      if (!(key.short_circuit_current_A > 0 && key.open_circuit_voltage_V > 0)) continue;
      sum.light_A += key.short_circuit_current_A;
      sum.voc_V += key.open_circuit_voltage_V;
      ++count;
    }
    if (count > 0) points.push_back({sum.light_A / count, sum.voc_V / count});
  }
  std::sort(points.begin(), points.end(),
            [](const VocPoint& a, const VocPoint& b) { return a.light_A < b.light_A; });
  return points;
}

}  // namespace

std::optional<IdealityOverLight> FindIdealityOverLight(std::vector<VocPoint> points,
                                                       double module_thermal_voltage_V) {
  if (points.size() < 2) return std::nullopt;
  std::sort(points.begin(), points.end(),
            [](const VocPoint& a, const VocPoint& b) { return a.light_A < b.light_A; });
  const Line line = LogLine(points);
  const Regression fit = Regress(line.x, line.y, 0, line.x.size());
  IdealityOverLight found;
  found.n.value = fit.slope / module_thermal_voltage_V;
  if (points.size() > 2) {
    const double reach = StudentT95(static_cast<int>(points.size()) - 2) * fit.slope_error /
                         module_thermal_voltage_V;
    found.n.low_95 = found.n.value - reach;
    found.n.high_95 = found.n.value + reach;
  }
  for (std::size_t k = 1; k < points.size(); ++k) {
    found.local.push_back(
        {points[k - 1].light_A, points[k].light_A,
         (line.y[k] - line.y[k - 1]) / (line.x[k] - line.x[k - 1]) / module_thermal_voltage_V});
  }
  found.rises_to_low_light = RisesToLowLight(found.local);
  found.points = std::move(points);
  return found;
}

std::vector<VocPoint> PointsOfLights(const std::vector<CellSweep>& sweeps) {
  std::vector<VocPoint> all = PointsOfAll(sweeps);
  for (const CellSweep& like : sweeps) {
    std::vector<CellSweep> series;
    for (const CellSweep& sweep : sweeps) {
      if (sweep.file == like.file && sweep.direction == like.direction) series.push_back(sweep);
    }
    std::vector<VocPoint> points = PointsOfAll(series);
    if (points.size() == all.size()) return points;
  }
  return all;
}

std::vector<VocPoint> PointsOfTrace(const CellSweep& sweep) {
  std::vector<VocPoint> points;
  for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
    const double light = sweep.suns_voc_A - sweep.current_A[k];
    if (light > 0 && sweep.voltage_V[k] > 0) points.push_back({light, sweep.voltage_V[k]});
  }
  std::sort(points.begin(), points.end(),
            [](const VocPoint& a, const VocPoint& b) { return a.light_A < b.light_A; });
  return points;
}

double VocAt(const std::vector<VocPoint>& points, double light_A) {
  return light_A > 0 ? LogLine(points).At(std::log(light_A)) : kUnknown;
}

DarkIdeality FindDarkIdeality(const CellSweep& dark, double module_thermal_voltage_V, int cells) {
  constexpr std::size_t kFewest = 5;
  constexpr double kWindow_V = 0.05, kNoises = 10, kPlateau = 1.1;
  constexpr double kNearZero_V = 0.025, kLeastPart = 0.5;
  std::vector<double> at, local, volt, logarithm;
  const double shunt_S = std::max(0.0, SlopeNearZero(dark, kNearZero_V * cells));
  for (std::size_t k = 0; k < dark.voltage_V.size(); ++k) {
    const double current = -dark.current_A[k], diode = current - shunt_S * dark.voltage_V[k];
    if (dark.voltage_V[k] <= 0 || !(diode > std::max(kNoises * dark.noise_A, kLeastPart * current)))
      continue;
    volt.push_back(dark.voltage_V[k]);
    logarithm.push_back(std::log(diode));
  }
  for (std::size_t first = 0; first + kFewest <= volt.size(); ++first) {
    std::size_t last = first + kFewest;
    while (last < volt.size() && volt[last] - volt[first] <= kWindow_V * cells) ++last;
    const Regression fit = Regress(volt, logarithm, first, last);
    if (!(fit.slope > 0)) continue;
    at.push_back(fit.mean_x);
    local.push_back(1 / fit.slope / module_thermal_voltage_V);
  }
  DarkIdeality found;
  if (local.empty()) return found;
  const std::size_t least = std::min_element(local.begin(), local.end()) - local.begin();
  found.least_n = local[least];
  found.at_V = at[least];
  std::size_t low = least, high = least;
  while (low > 0 && local[low - 1] <= kPlateau * found.least_n) --low;
  while (high + 1 < local.size() && local[high + 1] <= kPlateau * found.least_n) ++high;
  found.plateau_low_V = at[low];
  found.plateau_high_V = at[high];
  return found;
}

}  // namespace lyrefit
