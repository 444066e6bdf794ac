#include "lyrefit/estimate/fit/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/try.h"
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
  double current_A;  // largest |current|
  double voltage_V;  // Voc, or the largest voltage
};

CurveScales ScalesOf(const IvCurve& curve) {
  CurveScales scales{0, 0};
  for (std::size_t k = 0; k < curve.size(); ++k) {
    scales.current_A = std::max(scales.current_A, std::fabs(curve.current_A[k]));
    scales.voltage_V = std::max(scales.voltage_V, curve.voltage_V[k]);
  }
  // A dark curve crosses zero current at zero voltage, which is not an open-circuit voltage.
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  const bool lit = key.short_circuit_current_A > 0.01 * scales.current_A;
  if (lit && key.open_circuit_voltage_V > 0) scales.voltage_V = key.open_circuit_voltage_V;
  if (!(scales.voltage_V > 0)) {
    for (const double v : curve.voltage_V)
      scales.voltage_V = std::max(scales.voltage_V, std::fabs(v));
  }
  if (!(scales.current_A > 0)) scales.current_A = 1e-12;
  return scales;
}

std::vector<ParameterBounds> PhysicalBounds(const Device& device, const IvCurve& curve,
                                            double n_lower, double n_upper) {
  const CurveScales scales = ScalesOf(curve);
  const double resistance = scales.voltage_V / scales.current_A;
  // No single junction reaches 1.5 V. Above it the number of cells was not given and n is that of
  // all cells together. The range assumes 0.5 to 1.25 V per cell.
  const double per_cell_V = scales.voltage_V / curve.conditions.cells_in_series;
  if (per_cell_V > 1.5) {
    n_lower *= per_cell_V / 1.25;
    n_upper *= per_cell_V / 0.5;
  }
  const double vt = device.module_thermal_voltage_V;
  const auto saturation = [&](double n) {
    return scales.current_A * std::exp(-std::min(scales.voltage_V / (n * vt), 600.0));
  };
  std::vector<ParameterBounds> bounds(device.size());
  bounds[kIph] = Linear(0, 2 * scales.current_A);
  bounds[kRs] = {0, resistance, 0, 0.5 * resistance, SearchScale::kLinear};
  bounds[kRsh] = {0.1 * resistance, 1e12 * resistance, 0.5 * resistance, 1e4 * resistance,
                  SearchScale::kLog};
  for (int d = 0; d < DiodeCount(device); ++d) {
    const double top = 100 * saturation(n_upper);
    bounds[SaturationCurrentIndex(d)] = {0, top, 1e-3 * saturation(n_lower), top,
                                         SearchScale::kLog};
    bounds[IdealityIndex(d)] = Linear(n_lower, n_upper);
  }
  return bounds;
}

}  // namespace

Expected<void> CheckBoundsTable(const BoundsSpec::Table& table) {
  return CheckTable(table, MakeDevice(Model::kTripleDiode, {}), true);
}

Expected<std::vector<ParameterBounds>> MakeBounds(const BoundsSpec& spec, const Device& device,
                                                  const IvCurve& curve) {
  std::vector<ParameterBounds> bounds;
  if (spec.name == "physical") {
    constexpr double kSilicon = 2, kThinFilm = 6;
    bounds =
        PhysicalBounds(device, curve, 1, IsThinFilm(curve.notes.technology) ? kThinFilm : kSilicon);
  } else if (spec.name == "wide") {
    bounds = PhysicalBounds(device, curve, 0.5, 10);
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
