#include "lyrefit/read/select_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace lyrefit {
namespace {

struct Sweep {
  double first_voltage_V = 0;
  double last_voltage_V = 0;
  double irradiance_sum = 0;
  double temperature_sum = 0;
  int points = 0;

  double irradiance_W_m2() const { return irradiance_sum / points; }
  double temperature_C() const { return temperature_sum / points; }
};

std::map<int, Sweep> Summarise(const IvCurve& curve) {
  std::map<int, Sweep> sweeps;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    Sweep& sweep = sweeps[curve.sweep[i]];
    if (sweep.points++ == 0) sweep.first_voltage_V = curve.voltage_V[i];
    sweep.last_voltage_V = curve.voltage_V[i];
    if (!curve.irradiance_W_m2.empty()) sweep.irradiance_sum += curve.irradiance_W_m2[i];
    if (!curve.temperature_C.empty()) sweep.temperature_sum += curve.temperature_C[i];
  }
  return sweeps;
}

std::string Numbers(const std::map<int, Sweep>& sweeps) {
  constexpr int kShown = 10;
  std::string list;
  int shown = 0;
  for (const auto& [number, sweep] : sweeps) {
    if (shown++ == kShown) return list + ", ... " + std::to_string(sweeps.rbegin()->first);
    list += (list.empty() ? "" : ", ") + std::to_string(number);
  }
  return list;
}

bool SameConditions(const std::map<int, Sweep>& sweeps) {
  const Sweep& first = sweeps.begin()->second;
  return std::all_of(sweeps.begin(), sweeps.end(), [&](const auto& entry) {
    const Sweep& sweep = entry.second;
    const double brighter =
        std::max(std::abs(sweep.irradiance_W_m2()), std::abs(first.irradiance_W_m2()));
    return std::abs(sweep.irradiance_W_m2() - first.irradiance_W_m2()) <= 0.02 * brighter &&
           std::abs(sweep.temperature_C() - first.temperature_C()) <= 1;
  });
}

bool BothDirections(const std::map<int, Sweep>& sweeps) {
  const auto rises = [](const auto& entry) {
    return entry.second.last_voltage_V > entry.second.first_voltage_V;
  };
  const auto falls = [](const auto& entry) {
    return entry.second.last_voltage_V < entry.second.first_voltage_V;
  };
  return std::any_of(sweeps.begin(), sweeps.end(), rises) &&
         std::any_of(sweeps.begin(), sweeps.end(), falls);
}

template <class T>
void KeepRows(const std::vector<bool>& keep, std::vector<T>* values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values->size(); ++i) {
    if (keep[i]) (*values)[kept++] = (*values)[i];
  }
  values->resize(kept);
}

void KeepSweep(int wanted, IvCurve* curve) {
  std::vector<bool> keep(curve->size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = curve->sweep[i] == wanted;
  for (auto* column : {&curve->voltage_V, &curve->current_A, &curve->sigma_A, &curve->time_s,
                       &curve->irradiance_W_m2, &curve->temperature_C}) {
    KeepRows(keep, column);
  }
  KeepRows(keep, &curve->sweep);
}

}  // namespace

bool SweepsDifferInConditions(const IvCurve& curve) {
  return !curve.sweep.empty() && !SameConditions(Summarise(curve));
}

Expected<void> SelectSweep(std::optional<int> wanted, bool holds_curves, IvCurve* curve) {
  const char* kind = holds_curves ? "curves" : "sweeps";
  if (curve->sweep.empty()) {
    if (!wanted) return {};
    return Fail(
        fmt::format("curve {} was asked for, but the table has no column sweep or curve", *wanted));
  }
  const std::map<int, Sweep> sweeps = Summarise(*curve);
  if (wanted) {
    if (sweeps.count(*wanted) == 0) {
      return Fail(fmt::format("curve {} was asked for, but the table holds the {} {}", *wanted,
                              kind, Numbers(sweeps)));
    }
    if (sweeps.size() > 1) KeepSweep(*wanted, curve);
    return {};
  }
  if (sweeps.size() == 1) return {};
  std::string reason;
  if (!holds_curves) {
    if (!SameConditions(sweeps)) reason = " at different irradiance or temperature";
    if (reason.empty() && !BothDirections(sweeps)) reason = " in the same direction";
    if (reason.empty()) {
      curve->assumptions.push_back(fmt::format(
          "{} sweeps up and down at the same conditions read as one curve", sweeps.size()));
      return {};
    }
  }
  return Fail(fmt::format("expected one curve, found {} {}{} ({}): choose one with --curve INDEX",
                          sweeps.size(), kind, reason, Numbers(sweeps)));
}

}  // namespace lyrefit
