#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/devices/describe_sweep.h"
#include "lyrefit/read/stated_results.h"

namespace lyrefit {
namespace {

constexpr double kSameLight = 0.02;

bool IsSameLight(const CellSweep& a, const CellSweep& b) {
  return std::fabs(a.irradiance_W_m2 - b.irradiance_W_m2) <=
         kSameLight * std::max(a.irradiance_W_m2, b.irradiance_W_m2);
}

// Hours of sweeps whose files state dates only: since the first one.
void FindHours(const CurveSet& cell, std::vector<CellSweep>* sweeps) {
  std::map<std::string, double> at_s;
  double first_s = kInfinity;
  for (const IvCurve& curve : cell.curves) {
    const std::optional<double> date = ReadDateTime(curve.notes.date);
    if (!date) continue;
    at_s[curve.source] = *date;
    first_s = std::min(first_s, *date);
  }
  for (CellSweep& sweep : *sweeps) {
    const auto date = at_s.find(sweep.file);
    if (!std::isnan(sweep.elapsed_h) || date == at_s.end()) continue;
    sweep.elapsed_h = (date->second - first_s) / 3600;
  }
}

// Adds to the names of sweeps what tells them apart: rates and hours, where they differ.
void NameWhatDiffers(double CellSweep::*quantity, const char* unit,
                     std::vector<CellSweep>* sweeps) {
  constexpr double kSame = 0.05;
  double least = kInfinity, most = -kInfinity;
  for (const CellSweep& sweep : *sweeps) {
    least = std::fmin(least, sweep.*quantity);
    most = std::fmax(most, sweep.*quantity);
  }
  if (!(most - least > kSame * most)) return;
  for (CellSweep& sweep : *sweeps) {
    if (!std::isnan(sweep.*quantity))
      sweep.name += fmt::format(", {:.3g} {}", sweep.*quantity, unit);
  }
}

// Numbers sweeps of one name: "forward, dark (2)".
void NumberRepeats(std::vector<CellSweep>* sweeps) {
  std::map<std::string, int> seen;
  for (CellSweep& sweep : *sweeps) {
    const int count = ++seen[sweep.name];
    if (count > 1) sweep.name += fmt::format(" ({})", count);
  }
}

}  // namespace

void NameApart(const CurveSet& cell, std::vector<CellSweep>* sweeps) {
  FindHours(cell, sweeps);
  NameWhatDiffers(&CellSweep::scan_rate_V_s, "V/s", sweeps);
  NameWhatDiffers(&CellSweep::elapsed_h, "h", sweeps);
  NumberRepeats(sweeps);
}

double ReachedIsc(const CellSweep& sweep) { return sweep.key.short_circuit_current_A; }

int BrightestOf(const std::vector<CellSweep>& sweeps) {
  int main = -1;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (sweeps[i].kind != SweepKind::kLit || !(sweeps[i].key.max_power_W > 0)) continue;
    const bool brighter = main == -1 || (sweeps[i].irradiance_W_m2 > sweeps[main].irradiance_W_m2 &&
                                         !IsSameLight(sweeps[i], sweeps[main]));
    if (brighter) main = static_cast<int>(i);
  }
  return main;
}

int FindSweep(const CellReport& report, SweepKind kind, const CellSweep& like) {
  int found = -1;
  for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
    if (report.sweeps[i].kind != kind) continue;
    if (report.sweeps[i].direction == like.direction) return static_cast<int>(i);
    if (found == -1) found = static_cast<int>(i);
  }
  return found;
}

std::vector<int> LightsOf(const CellReport& report, double (*isc_of)(const CellSweep&)) {
  std::vector<int> lights;
  for (std::size_t i = 0; report.main != -1 && i < report.sweeps.size(); ++i) {
    const CellSweep& sweep = report.sweeps[i];
    if (sweep.kind != SweepKind::kLit || sweep.direction != report.sweeps[report.main].direction) {
      continue;
    }
    const bool known = std::any_of(lights.begin(), lights.end(), [&](int other) {
      return IsSameLight(report.sweeps[other], sweep);
    });
    if (!known && isc_of(sweep) > 0) lights.push_back(static_cast<int>(i));
  }
  std::stable_sort(lights.begin(), lights.end(), [&](int a, int b) {
    return report.sweeps[a].irradiance_W_m2 > report.sweeps[b].irradiance_W_m2;
  });
  return lights;
}

std::vector<int> BrightestSweeps(const CellReport& report) {
  std::vector<int> brightest;
  for (std::size_t i = 0; report.main != -1 && i < report.sweeps.size(); ++i) {
    const CellSweep& sweep = report.sweeps[i];
    if (sweep.kind == SweepKind::kLit && IsSameLight(sweep, report.sweeps[report.main])) {
      brightest.push_back(static_cast<int>(i));
    }
  }
  return brightest;
}

namespace {

// A quantity that files state, in V, A, W or as a fraction.
struct Quantity {
  std::vector<std::string> names;
  double value = kUnknown;     // in the base unit
  double per_area = kUnknown;  // over the area in cm2
};

std::vector<Quantity> QuantitiesOf(const CellSweep& sweep, double area_cm2) {
  const KeyPoints& key = sweep.key;
  const auto over_area = [&](double value) { return value / area_cm2; };
  const double isc = key.short_circuit_current_A, imp = key.max_power_current_A;
  return {{{"isc", "jsc"}, isc, over_area(isc)},
          {{"voc"}, key.open_circuit_voltage_V},
          {{"imp", "impp", "jmp", "jmpp"}, imp, over_area(imp)},
          {{"vmp", "vmpp", "umpp"}, key.max_power_voltage_V},
          {{"pmp", "pmpp", "pmax", "mpp"}, key.max_power_W, over_area(key.max_power_W)},
          {{"ff", "fillfactor"}, key.fill_factor},
          {{"eff", "efficiency", "pce"}, sweep.efficiency}};
}

// A unit: its factor from the base unit, and whether it is per area.
struct StatedUnit {
  const char* text;
  double factor;
  bool per_area;
};

constexpr StatedUnit kStatedUnits[] = {
    {"v", 1, false},     {"mv", 1e3, false},     {"a", 1, false},      {"ma", 1e3, false},
    {"acm2", 1, true},   {"macm2", 1e3, true},   {"am2", 1e4, true},   {"w", 1, false},
    {"mw", 1e3, false},  {"wcm2", 1, true},      {"mwcm2", 1e3, true}, {"wm2", 1e4, true},
    {"pct", 100, false}, {"percent", 100, false}};

// Largest difference in ln of a stated density from a reading that is one.
constexpr double kReadingsAreDensities = 0.1;

// The value of the quantity in the unit of the label. Without a unit: that of the usual ones which
// is nearest to the stated value.
double FoundIn(const Quantity& quantity, const std::string& unit, double stated) {
  for (const StatedUnit& one : kStatedUnits) {
    if (unit == one.text) return one.factor * (one.per_area ? quantity.per_area : quantity.value);
  }
  double nearest = kUnknown;
  for (const double value :
       {quantity.value, 100 * quantity.value, 1e3 * quantity.value, 1e3 * quantity.per_area}) {
    if (!std::isfinite(value)) continue;
    const double away = std::fabs(std::log(std::fabs(stated / value)));
    if (!(away >= std::fabs(std::log(std::fabs(stated / nearest))))) nearest = value;
  }
  return nearest;
}

}  // namespace

std::vector<StatedKeyPoint> CompareStated(const std::vector<StatedResult>& results,
                                          const CellSweep& sweep, double area_cm2) {
  std::vector<StatedKeyPoint> found;
  if (sweep.kind != SweepKind::kLit) return found;
  for (const StatedResult& result : results) {
    const std::string name = ResultName(result.label);
    for (const Quantity& quantity : QuantitiesOf(sweep, area_cm2)) {
      if (std::find(quantity.names.begin(), quantity.names.end(), name) == quantity.names.end()) {
        continue;
      }
      const double stated = std::fabs(result.value);
      const double value = FoundIn(quantity, ResultUnit(result.label), stated);
      // Without an area a density is comparable only if the readings are densities too.
      const bool density = name.front() == 'j' && !std::isfinite(area_cm2);
      if (density && std::fabs(std::log(stated / value)) > kReadingsAreDensities) continue;
      if (std::isfinite(value)) found.push_back({result.label, stated, value, result.source});
    }
  }
  return found;
}

}  // namespace lyrefit
