// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/trend_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "lyrefit/base/median.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/trend/fit_sweep.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLeastReadings = 8;
constexpr double kMostLight = 1.5;  // of what the law lets expect in light that is no dusk
constexpr double kBright_W_m2 = 200;

bool IsSweep(const IvCurve& curve) {
  return curve.size() >= kLeastReadings && curve.irradiance_known && curve.temperature_known &&
         curve.conditions.irradiance_W_m2 > 0;
}

double Celsius(const IvCurve& curve) {
  return curve.conditions.cell_temperature_K - kZeroCelsius_K;
}

// Ns Vt in V.
double ThermalAtOne(const IvCurve& curve) {
  return curve.conditions.ModuleThermalVoltage(ConstantSet::kCodata);
}

// ln of the first diode's saturation current at T over that at 25 C, and half the band gap's part
// of it.
struct SaturationShift {
  double first;
  double second;
};

SaturationShift ShiftAt(const TrendDevice& device, double temperature_C) {
  const double kelvin = temperature_C + kZeroCelsius_K;
  const double k_eV = ThermalVoltage(1.0, ConstantSet::kCodata);
  const double ratio = std::log(kelvin / kReferenceTemperature_K);
  const double barrier = DeSotoBarrier(device.bandgap_eV, device.bandgap_slope_per_K,
                                       kReferenceTemperature_K, kelvin, k_eV);
  return {3 * ratio + barrier, 2.5 * ratio + 0.5 * barrier};
}

// exp(V / 2 a) at which diodes with these saturation currents carry a current: without a shunt the
// root of a quadratic equation, in a thirtieth of the time of ModelOpenCircuit.
double HalfExponential(double current, double first, double second) {
  if (!(first > 0)) return current / second;
  return 2 * current / (second + std::sqrt(second * second + 4 * first * current));
}

// Substrings without voltage: what is missing of Voc, if it is near a whole number of them.
int LostSubstrings(const TrendDevice& device, double voc_V, double expected_V) {
  constexpr int kMostTold = 8;    // beyond, one is as small as the errors of a temperature
  constexpr double kNear = 0.35;  // of a substring
  if (device.substrings < 2 || device.substrings > kMostTold) return 0;
  const double lost = device.substrings * (1 - voc_V / expected_V);
  const double whole = std::round(lost);
  if (whole < 1 || whole >= device.substrings || std::fabs(lost - whole) > kNear) return 0;
  return static_cast<int>(whole);
}

// Ideality of the first diode, so that those of both have that of a single one between them.
double FirstIdeality(double single) {
  constexpr double kMostOfTwo = 1.6;
  if (single < 1.05) return std::min(1.0, 0.95 * single);
  return single <= kMostOfTwo ? 1 : single / 1.4;
}

// A device whose light, cells and coefficients are those that the sweeps state.
TrendDevice StatedDevice(const std::vector<const IvCurve*>& sweeps) {
  TrendDevice device;
  std::map<int, int> sweeps_of;  // by the number of cells that they state
  for (const IvCurve* curve : sweeps) {
    const int cells = curve->conditions.cells_in_series;
    if (++sweeps_of[cells] > sweeps_of[device.cells_in_series]) device.cells_in_series = cells;
  }
  for (const IvCurve* curve : sweeps) {
    const DeviceNotes& notes = curve->notes;
    device.substrings = notes.bypass_diodes.value_or(device.substrings);
    device.bandgap_eV = notes.bandgap_eV.value_or(device.bandgap_eV);
    device.bandgap_slope_per_K = notes.bandgap_slope_per_K.value_or(device.bandgap_slope_per_K);
    device.isc_tempco_per_K = notes.isc_tempco_per_K.value_or(device.isc_tempco_per_K);
  }
  return device;
}

// Why these readings are none of a device in the open.
std::optional<std::string> DoubtOf(const TrendDevice& device, const IvCurve& curve) {
  constexpr double kMost_W_m2 = 2000;
  if (curve.conditions.irradiance_W_m2 > kMost_W_m2) {
    return fmt::format("an irradiance of {:.4g} W/m2, expected at most {:g}",
                       curve.conditions.irradiance_W_m2, kMost_W_m2);
  }
  const int cells = curve.conditions.cells_in_series;
  if (curve.cells_known && cells != device.cells_in_series) {
    return fmt::format("a sweep of {} cells in series, the law is of {}", cells,
                       device.cells_in_series);
  }
  return PlausibilityProblem(curve);
}

std::vector<SweepFit> FitAll(const TrendDevice& device, const std::vector<const IvCurve*>& sweeps,
                             double n, SweepFree free, std::vector<const IvCurve*>* fitted) {
  std::vector<SweepFit> fits;
  fitted->clear();
  for (const IvCurve* curve : sweeps) {
    if (!IsSweep(*curve) || DoubtOf(device, *curve)) continue;
    const SweepFit fit =
        FitSweep(curve->voltage_V, curve->current_A, ThermalAtOne(*curve), n, free);
    if (!fit.usable) continue;
    fits.push_back(fit);
    fitted->push_back(curve);
  }
  return fits;
}

template <class Value>
double MedianOf(const std::vector<SweepFit>& fits, const Value& value) {
  std::vector<double> values;
  values.reserve(fits.size());
  for (const SweepFit& fit : fits) values.push_back(value(fit));
  return Median(std::move(values));
}

}  // namespace

double TrendDevice::ThermalVoltage(double temperature_C) const {
  return n * cells_in_series *
         lyrefit::ThermalVoltage(temperature_C + kZeroCelsius_K, ConstantSet::kCodata);
}

double TrendDevice::Photocurrent(double irradiance_W_m2, double temperature_C) const {
  return photocurrent_A * irradiance_W_m2 / kReferenceIrradiance_W_m2 *
         (1 + isc_tempco_per_K * (temperature_C - kReferenceTemperature_C));
}

double TrendDevice::OpenCircuit(double photocurrent, double temperature_C) const {
  const SaturationShift shift = ShiftAt(*this, temperature_C);
  const double half = HalfExponential(photocurrent, saturation_current_A * std::exp(shift.first),
                                      saturation_current_2_A * std::exp(shift.second));
  return 2 * ThermalVoltage(temperature_C) * std::log(half);
}

DeviceState StateOf(const TrendDevice& device,
                    const std::array<double, kTrendParameters>& parameters, double expected_A,
                    double temperature_C) {
  const double voc = device.OpenCircuit(expected_A, temperature_C) + parameters[kTrendVoltage];
  const double half = std::exp(-0.5 * voc / device.ThermalVoltage(temperature_C));
  const double second = std::min(parameters[kTrendSecond], 1.0);
  return {expected_A * std::exp(parameters[kTrendLight]), std::max(parameters[kTrendSeries], 0.0),
          (1 - second) * expected_A * half * half, second * expected_A * half,
          std::max(parameters[kTrendShunt], 0.0)};
}

TrendPoint MaximumPowerPoint(const TrendDevice& device, const DeviceState& state,
                             double temperature_C) {
  // P = I (Vd - I Rs), where I is a function of the junction voltage Vd alone: the root of
  // dP/dVd = I + (Vd - 2 Rs I) I'.
  const double a = device.ThermalVoltage(temperature_C);
  const double iph = state.photocurrent_A, rs = state.resistance_series_ohm;
  const double voc =
      2 * a *
      std::log(HalfExponential(iph, state.saturation_current_A, state.saturation_current_2_A));
  const PreparedDevice terms = TwoDiodes(iph, state.shunt_conductance_S, state.saturation_current_A,
                                         state.saturation_current_2_A, a);
  BentCurrent<double> at{};
  const auto rise = [&](double junction) {
    PreparedBent<1>(terms, &junction, &at);
    return at.value + (junction - 2 * rs * at.value) * at.slope;
  };
  const double junction = RootBetween(rise, 0, voc);
  rise(junction);
  return {junction - at.value * rs, at.value};
}

Expected<TrendDevice> DeviceOfModule(const NamedParameters& module) {
  const Translation& law = module.translation;
  if (law.spec.model != Model::kSingleDiode) {
    return Fail("a trend needs a module with one diode, this one has two", module.name);
  }
  const auto at = [&](int position, double missing) {
    return position >= 0 ? module.shared[position] : missing;
  };
  TrendDevice device;
  device.cells_in_series = law.spec.cells_in_series;
  device.n = at(law.n, device.n);
  device.bandgap_eV = at(law.bandgap, device.bandgap_eV);
  device.bandgap_slope_per_K = at(law.bandgap_slope, 0);
  device.photocurrent_A = at(law.photocurrent, 0);
  const double alpha = at(law.alpha_sc, 0) * (1 - 0.01 * at(law.adjust, 0));
  if (!(device.photocurrent_A > 0)) return Fail("the module has no photocurrent", module.name);
  device.isc_tempco_per_K = alpha / device.photocurrent_A;
  device.resistance_series_ohm = at(law.resistance_series, 0);
  device.saturation_current_A = at(law.saturation_current, 0);
  device.shunt_conductance_S = 1 / at(law.resistance_shunt, kInfinity);
  return device;
}

Expected<TrendDevice> DeviceOfSweeps(const std::vector<const IvCurve*>& sweeps) {
  TrendDevice device = StatedDevice(sweeps);
  std::vector<const IvCurve*> fitted;
  const std::vector<SweepFit> single = FitAll(device, sweeps, 1.2, SweepFree::kIdeality, &fitted);
  if (!single.empty()) {
    device.n = FirstIdeality(MedianOf(single, [](const SweepFit& fit) { return fit.n; }));
  }
  const std::vector<SweepFit> fits =
      FitAll(device, sweeps, device.n, SweepFree::kSecondDiode, &fitted);
  if (fits.empty()) {
    std::string why;
    for (const IvCurve* curve : sweeps) {
      if (why.empty()) why = DoubtOf(device, *curve).value_or("");
    }
    return Fail(fmt::format(
        "expected sweeps from 0 V to open circuit with their irradiance and temperature, found "
        "none in the reference days{}{}",
        why.empty() ? "" : ": ", why));
  }
  device.resistance_series_ohm =
      MedianOf(fits, [](const SweepFit& fit) { return fit.resistance_series_ohm; });
  device.shunt_conductance_S =
      MedianOf(fits, [](const SweepFit& fit) { return fit.shunt_conductance_S; });
  std::vector<double> iph, first, second;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const SweepFit& fit = fits[k];
    const double celsius = Celsius(*fitted[k]);
    const double half = std::exp(-0.5 * fit.open_circuit_V / device.ThermalVoltage(celsius));
    const SaturationShift shift = ShiftAt(device, celsius);
    first.push_back(fit.diode_A * half * half * std::exp(-shift.first));
    second.push_back(fit.diode_2_A * half * std::exp(-shift.second));
    const double light = fitted[k]->conditions.irradiance_W_m2 / kReferenceIrradiance_W_m2;
    const double warm = 1 + device.isc_tempco_per_K * (celsius - kReferenceTemperature_C);
    iph.push_back(fit.photocurrent_A / (light * warm));
  }
  device.photocurrent_A = Median(iph);
  device.saturation_current_A = Median(first);
  device.saturation_current_2_A = std::max(Median(second), 0.0);
  return device;
}

TrendRow ReduceSweep(const TrendDevice& device, const IvCurve& curve, double time_s) {
  TrendRow row;
  row.time_s = time_s;
  if (curve.irradiance_known) row.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
  if (curve.temperature_known) row.temperature_C = Celsius(curve);
  if (curve.size() < kLeastReadings) {
    row.reason = "fewer than eight readings";
    return row;
  }
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  row.isc_A = key.short_circuit_current_A;
  row.voc_V = key.open_circuit_voltage_V;
  row.voltage_V = key.max_power_voltage_V;
  row.current_A = key.max_power_current_A;
  if (!curve.irradiance_known || !curve.temperature_known) {
    row.reason = curve.irradiance_known ? "no temperature" : "no irradiance";
    return row;
  }
  if (!(row.isc_A > 0) || !(row.voc_V > 0) || !(row.irradiance_W_m2 > 0)) {
    row.reason = row.irradiance_W_m2 > 0 ? "no short circuit or no open circuit" : "dark";
    return row;
  }
  if (const std::optional<std::string> doubt = DoubtOf(device, curve)) {
    row.state = TrendRowState::kDoubtful;
    row.reason = *doubt;
    return row;
  }
  row.lost_substrings =
      LostSubstrings(device, row.voc_V, device.OpenCircuit(row.isc_A, row.temperature_C));
  double left = 1;
  SweepFit fit = FitSweep(curve.voltage_V, curve.current_A, ThermalAtOne(curve), device.n,
                          SweepFree::kSecondDiode);
  if (row.lost_substrings > 0) {
    // Leaky cells lose voltage too, but fit as what they are.
    constexpr double kClearlyBetter = 0.4;
    left -= static_cast<double>(row.lost_substrings) / device.substrings;
    const SweepFit fewer = FitSweep(curve.voltage_V, curve.current_A, ThermalAtOne(curve) * left,
                                    device.n, SweepFree::kSecondDiode);
    if (fewer.usable && !(fit.usable && fit.rms_A <= kClearlyBetter * fewer.rms_A)) {
      fit = fewer;
    } else {
      row.lost_substrings = 0;
      left = 1;
    }
  }
  if (!fit.usable) {
    row.reason = "no diode model describes it";
    return row;
  }
  // The voltage at which both diodes carry the expected photocurrent.
  const double expected_A = device.Photocurrent(row.irradiance_W_m2, row.temperature_C);
  const double a = device.ThermalVoltage(row.temperature_C);
  const double half = HalfExponential(expected_A, fit.diode_A, fit.diode_2_A);
  const double voc = fit.open_circuit_V / left + 2 * a * std::log(half);
  row.parameters = {std::log(fit.photocurrent_A / expected_A), fit.resistance_series_ohm / left,
                    voc - device.OpenCircuit(expected_A, row.temperature_C),
                    fit.diode_2_A * half / expected_A, fit.shunt_conductance_S * left};
  row.misfit = fit.rms_A / row.isc_A;
  row.state = TrendRowState::kUsed;
  const double times = fit.photocurrent_A / expected_A;
  if (times > kMostLight && row.irradiance_W_m2 > kBright_W_m2) {
    row.state = TrendRowState::kDoubtful;
    row.reason = fmt::format(
        "{:.1f} times the current of the first sweeps in such light: they or the light sensor "
        "were in shade, or these are of another number of strings",
        times);
  }
  if (!std::isfinite(voc)) {
    row.state = TrendRowState::kUnusable;
    row.reason = "no diode model describes it";
  }
  return row;
}

}  // namespace lyrefit
