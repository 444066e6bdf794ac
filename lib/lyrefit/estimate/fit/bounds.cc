#include "lyrefit/estimate/fit/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {
namespace {

// Symbol without its diode number: "Is" for "Is2", "n" for "n1".
std::string Group(const std::string& symbol) {
  return symbol.substr(0, symbol.find_last_not_of("0123456789") + 1);
}

// Range of a parameter in a table, by its symbol or name, else by its symbol without number. Null:
// none.
const std::pair<double, double>* Lookup(const BoundsSpec::Table& table, const ParameterInfo& info) {
  for (const std::string& key : {info.symbol, info.name, Group(info.symbol)}) {
    if (const auto found = table.find(key); found != table.end()) return &found->second;
  }
  return nullptr;
}

bool Known(const std::string& key, const Device& device) {
  return device.Find(key).has_value() ||
         std::any_of(device.parameters.begin(), device.parameters.end(),
                     [&](const ParameterInfo& info) { return Group(info.symbol) == key; });
}

Expected<void> CheckTable(const BoundsSpec::Table& table, const Device& device, bool all_known) {
  for (const auto& [key, range] : table) {
    const auto [lower, upper] = range;
    if (all_known && !Known(key, device)) {
      std::string known;
      for (const ParameterInfo& info : device.parameters) {
        known += (known.empty() ? "" : ", ") + info.symbol;
      }
      return Fail(
          fmt::format("bounds of '{}': this model has no such parameter; it has {}", key, known));
    }
    if (!std::isfinite(lower) || !std::isfinite(upper)) {
      return Fail(fmt::format("bounds of {} must be finite numbers", key));
    }
    if (lower > upper) {
      return Fail(fmt::format("bounds of {} are reversed: {:g} is above {:g}", key, lower, upper));
    }
    if (lower < 0) {
      return Fail(fmt::format("bounds of {} start at {:g}, expected 0 or more", key, lower));
    }
    if (Group(key) == "n" && upper <= 0) {
      return Fail(fmt::format("bounds of {} end at {:g}, expected more than 0", key, upper));
    }
  }
  return {};
}

ParameterBounds Linear(double lower, double upper) {
  return {lower, upper, lower, upper, SearchScale::kLinear};
}

// Current and voltage scales of a curve for the physical bounds.
struct CurveScales {
  bool dark = false;
  double current_A = 0;  // largest delivered current; of a dark curve, largest forward current
  double voltage_V = 0;  // Voc, or the largest voltage
};

CurveScales ScalesOf(const IvCurve& curve) {
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  const auto highest = std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
  CurveScales scales{IsDark(curve) || !(*highest > 0), 0, *highest};
  // At reverse voltage a junction may break down. Beyond Voc the forward current has no limit.
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double current_A = curve.current_A[k];
    const double counted_A = !scales.dark             ? current_A
                             : curve.voltage_V[k] > 0 ? std::fabs(current_A)
                                                      : 0;
    scales.current_A = std::max(scales.current_A, counted_A);
  }
  // A dark curve crosses zero current at zero voltage, which is not an open-circuit voltage.
  if (!scales.dark && key.open_circuit_voltage_V > 0) scales.voltage_V = key.open_circuit_voltage_V;
  if (!(scales.voltage_V > 0)) scales.voltage_V = LargestMagnitude(curve.voltage_V);
  if (!(scales.current_A > 0)) scales.current_A = LargestMagnitude(curve.current_A);
  if (!(scales.current_A > 0)) scales.current_A = 1e-12;
  return scales;
}

// Range of n, per cell.
struct IdealityRange {
  double lower;
  double upper;
};

constexpr IdealityRange kAnyIdeality = {0.5, 10};

// No single junction reaches 1.5 V. Above it the number of cells was not given and n is that of all
// cells together. The range assumes 0.5 to 1.25 V per cell. In the dark the voltage may be that of
// the series resistance or of one wide gap, so only the upper end moves, and a stated number of
// cells stands.
IdealityRange OfAllCells(const CurveScales& scales, const IvCurve& curve, IdealityRange of_cell) {
  const double per_cell_V = scales.voltage_V / curve.conditions.cells_in_series;
  if (!(per_cell_V > 1.5) || (scales.dark && curve.cells_known)) return of_cell;
  const double lower = scales.dark ? 1 : per_cell_V / 1.25;
  return {of_cell.lower * lower, of_cell.upper * per_cell_V / 0.5};
}

std::vector<ParameterBounds> PhysicalBounds(const Device& device, const IvCurve& curve,
                                            const CurveScales& scales, IdealityRange of_cell) {
  const double resistance = scales.voltage_V / scales.current_A;
  const IdealityRange n = OfAllCells(scales, curve, of_cell);
  const double vt = device.module_thermal_voltage_V;
  const auto saturation = [&](double ideality) {
    return scales.current_A * std::exp(-std::min(scales.voltage_V / (ideality * vt), 600.0));
  };
  std::vector<ParameterBounds> bounds(device.size());
  bounds[kIph] = Linear(0, 2 * scales.current_A);
  bounds[kRs] = {0, resistance, 0, 0.5 * resistance, SearchScale::kLinear};
  bounds[kRsh] = {0.1 * resistance, 1e12 * resistance, 0.5 * resistance, 1e4 * resistance,
                  SearchScale::kLog};
  // The series resistance may take nearly all of the last voltage of a dark curve. No saturation
  // current is above the forward current.
  const double top = scales.dark ? scales.current_A : 100 * saturation(n.upper);
  for (int d = 0; d < DiodeCount(device); ++d) {
    bounds[SaturationCurrentIndex(d)] = {0, top, 1e-3 * saturation(n.lower), top,
                                         SearchScale::kLog};
    bounds[IdealityIndex(d)] = Linear(n.lower, n.upper);
  }
  return bounds;
}

// n of a junction is 1 to 2 by diffusion and recombination. That of a thin film's curve at light
// also holds collection, ions and barriers. One diode for a dark curve holds whatever conducts:
// light-emitting diodes and tunnelling have 2 to 7 (Shah et al., J. Appl. Phys. 94, 2627, 2003).
IdealityRange PhysicalIdeality(const Device& device, const IvCurve& curve,
                               const CurveScales& scales) {
  if (scales.dark && DiodeCount(device) == 1) return kAnyIdeality;
  constexpr double kSilicon = 2, kThinFilm = 6;
  return {1, IsThinFilm(curve.notes.technology) ? kThinFilm : kSilicon};
}

}  // namespace

Expected<void> CheckBoundsTable(const BoundsSpec::Table& table) {
  return CheckTable(table, MakeDevice(Model::kTripleDiode, {}), true);
}

Expected<std::vector<ParameterBounds>> MakeBounds(const BoundsSpec& spec, const Device& device,
                                                  const IvCurve& curve) {
  std::vector<ParameterBounds> bounds;
  if (spec.name == "physical") {
    const CurveScales scales = ScalesOf(curve);
    bounds = PhysicalBounds(device, curve, scales, PhysicalIdeality(device, curve, scales));
  } else if (spec.name == "wide") {
    bounds = PhysicalBounds(device, curve, ScalesOf(curve), kAnyIdeality);
  } else {
    // A table may have bounds of diodes that this model lacks, so that one file serves every model.
    const Device largest = MakeDevice(Model::kTripleDiode, curve.conditions);
    TRY(CheckTable(spec.table, largest, true));
    for (const ParameterInfo& info : device.parameters) {
      const auto* range = Lookup(spec.table, info);
      if (range == nullptr) {
        return Fail(fmt::format("bounds '{}' leave out {}", spec.name, info.symbol));
      }
      bounds.push_back(Linear(range->first, range->second));
    }
  }
  TRY(CheckTable(spec.overrides, device, true));
  for (int i = 0; i < device.size(); ++i) {
    const auto* range = Lookup(spec.overrides, device.parameters[i]);
    if (range != nullptr) bounds[i] = Linear(range->first, range->second);
  }
  return bounds;
}

}  // namespace lyrefit
