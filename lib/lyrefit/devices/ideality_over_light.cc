#include "lyrefit/devices/cell_figures.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/roots.h"
#include "lyrefit/devices/line.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewLights = 12;  // whose voltages do not show their noise

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

// Voc = slope ln(light - shunt Voc) + constant by least squares, with the shunt given.
struct BesideShunt {
  double slope = kUnknown;
  double squares = kInfinity;     // sum of the squared deviations, V^2
  Eigen::VectorXd left;           // deviation of each voltage
  Eigen::MatrixXd by_parameters;  // of each voltage by slope, constant and shunt
};

// An error of Voc counts once more in the current of the shunt.
BesideShunt FitBesideShunt(const std::vector<VocPoint>& points, double shunt_S, double slope) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd by(count, 3);
  Eigen::VectorXd voltage(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const VocPoint& point = points[k];
    const double junction_A = point.light_A - shunt_S * point.voc_V;
    if (!(junction_A > 0)) return {};
    const double part = 1 / (1 + slope * shunt_S / junction_A);
    by.row(k) << part * std::log(junction_A), part, -part * slope * point.voc_V / junction_A;
    voltage[k] = part * point.voc_V;
  }
  const Eigen::Vector2d found = by.leftCols(2).colPivHouseholderQr().solve(voltage);
  const Eigen::VectorXd left = voltage - by.leftCols(2) * found;
  return {found[0], left.squaredNorm(), left, by};
}

// The points from 1/30 to 3 times `isc_A`, at least the four brightest of them and of the darker ones.
std::vector<VocPoint> PointsAround(const std::vector<VocPoint>& points, double isc_A) {
  constexpr double kBelow = 30, kAbove = 3;
  constexpr std::size_t kFewest = 4;
  const double top = isc_A > 0 ? isc_A : points.back().light_A;
  std::vector<VocPoint> around;
  for (auto point = points.rbegin(); point != points.rend(); ++point) {
    const bool near = point->light_A >= top / kBelow || around.size() < kFewest;
    if (point->light_A <= kAbove * top && near) around.push_back(*point);
  }
  return around;
}

// Standard errors of slope, constant and shunt (where `parameters` has it): by the scatter of the voltages, at least `noise_V`, which
// neighbours may share.
Eigen::VectorXd ErrorsBesideShunt(const BesideShunt& fit, Eigen::Index parameters, double noise_V) {
  const Eigen::VectorXd& left = fit.left;
  const Eigen::Index count = left.size(), degrees = count - parameters;
  const double scatter = degrees > 0 ? fit.squares / static_cast<double>(degrees) : 0;
  const double next = left.head(count - 1).dot(left.tail(count - 1));
  const double shared = degrees > 3 ? std::clamp(next / fit.squares, 0.0, 0.9) : 0;
  const double variance = std::max(noise_V * noise_V, scatter * (1 + shared) / (1 - shared));
  const Eigen::MatrixXd by = fit.by_parameters.leftCols(parameters);
  return (variance * (by.transpose() * by).inverse().diagonal()).cwiseSqrt();
}

// n of the junction around `isc_A`, whose light a shunt shares, and this.
void FindJunction(double isc_A, double noise_V, double thermal_V, IdealityOverLight* found) {
  const std::vector<VocPoint> points = PointsAround(found->points, isc_A);
  if (points.size() < 2) return;
  double slope = FitBesideShunt(points, 0, 0).slope, shunt_S = 0;
  if (points.size() > 3) {
    double most_S = kInfinity;
    for (const VocPoint& point : points) most_S = std::min(most_S, point.light_A / point.voc_V);
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
      const auto fits = [&](double shunt) { return -FitBesideShunt(points, shunt, slope).squares; };
      const double best_S = MaximumBetween(fits, 0, 0.99 * most_S);
      shunt_S = fits(best_S) > fits(0) ? best_S : 0;
      slope = FitBesideShunt(points, shunt_S, slope).slope;
    }
  }
  const Eigen::Index parameters = points.size() > 3 && shunt_S > 0 ? 3 : 2;
  const BesideShunt fit = FitBesideShunt(points, shunt_S, slope);
  const Eigen::VectorXd errors = ErrorsBesideShunt(fit, parameters, noise_V);
  const int degrees = static_cast<int>(points.size() - parameters);
  found->noise_V = degrees > 0 ? std::sqrt(fit.squares / degrees) : 0;
  const double times = degrees > 0 && found->points.size() >= kFewLights ? StudentT95(degrees) : 2;
  const double reach = times * errors[0];
  found->junction = {slope / thermal_V, (slope - reach) / thermal_V, (slope + reach) / thermal_V};
  found->shunt_S = {shunt_S, 0, 0};
  if (parameters < 3) return;
  found->shunt_S.low_95 = shunt_S - times * errors[2];
  found->shunt_S.high_95 = shunt_S + times * errors[2];
}

// n of the two of a few lights around `isc_A`, which do not show how n changes along them.
void TakePair(double isc_A, double noise_V, double thermal_V, IdealityOverLight* found) {
  LocalIdeality pair = found->local.front();
  for (const LocalIdeality& local : found->local) {
    if (!(local.low_A >= isc_A)) pair = local;
  }
  const double error = std::sqrt(2.0) * noise_V / thermal_V / std::log(pair.high_A / pair.low_A);
  found->junction = {pair.n, pair.n - 2 * error, pair.n + 2 * error};
}

// Where the next point of a local n lies, at least: where noise leaves 5 % of its slope.
std::size_t NextPoint(const Line& line, std::size_t from, double noise_V, double thermal_V) {
  constexpr double kErrors = 20;
  const double least = kErrors * std::sqrt(2.0) * noise_V / thermal_V;
  std::size_t k = from + 1;
  while (k < line.x.size() && line.x[k] - line.x[from] < least) ++k;
  return k;
}

}  // namespace

std::optional<IdealityOverLight> FindIdealityOverLight(std::vector<VocPoint> points,
                                                       double module_thermal_voltage_V,
                                                       double isc_A) {
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
  found.points = points;
  // A few lights are not set closer than their lamp and the cell's temperature hold still.
  constexpr double kSetting = 0.02;  // of the thermal voltage: 0.5 mV a cell
  const bool few = points.size() < kFewLights;
  const double setting_V = few ? kSetting * module_thermal_voltage_V : 0;
  FindJunction(isc_A, setting_V, module_thermal_voltage_V, &found);
  // Where n changes along the lights, neighbours tell their noise better than the one law.
  found.noise_V = few ? 0 : std::min(found.noise_V, NoiseFromDifferences(line.x, line.y));
  for (std::size_t low = 0, k = 0; low + 1 < points.size(); low = k) {
    k = NextPoint(line, low, found.noise_V, module_thermal_voltage_V);
    if (k == points.size()) {
      if (!found.local.empty()) break;
      k = points.size() - 1;
    }
    found.local.push_back(
        {points[low].light_A, points[k].light_A,
         (line.y[k] - line.y[low]) / (line.x[k] - line.x[low]) / module_thermal_voltage_V});
  }
  found.rises_to_low_light = RisesToLowLight(found.local);
  if (few) TakePair(isc_A, setting_V, module_thermal_voltage_V, &found);
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
