#include "lyrefit/trend/trend_device.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/estimate/refine/least_squares.h"
#include "lyrefit/model/single_diodes.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/key_points.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLeastReadings = 8;

// Positions in the vector that is fitted; n is the last.
enum FittedAt { kFitIph, kFitLnIs, kFitRs, kFitGsh, kFitN, kFitted };

SingleDiodes DiodeOf(const double* iph, const double* is, const double* rs, const double* rsh,
                     const double* a, std::size_t size) {
  SingleDiodes diode;
  diode.size = size;
  diode.photocurrent = {iph, 0};
  diode.saturation_current = {is, 0};
  diode.resistance_series = {rs, 0};
  diode.resistance_shunt = {rsh, 0};
  diode.nNsVth = {a, 0};
  return diode;
}

// Currents of the readings less the measured ones, and their derivatives by the implicit equation.
bool EvaluateSweep(const std::vector<double>& voltage, const std::vector<double>& current,
                   double thermal_V, const double* p, double* residuals, double* jacobian) {
  const double a = p[kFitN] * thermal_V;
  const double is = std::exp(p[kFitLnIs]);
  const double rsh = p[kFitGsh] > 0 ? 1 / p[kFitGsh] : kInfinity;
  const std::size_t size = voltage.size();
  CurrentsAt(DiodeOf(p + kFitIph, &is, p + kFitRs, &rsh, &a, size), {voltage.data(), 1},
             residuals);
  for (std::size_t k = 0; k < size; ++k) {
    if (!std::isfinite(residuals[k])) return false;
    if (jacobian != nullptr) {
      const double junction = voltage[k] + residuals[k] * p[kFitRs];
      const double rise = std::exp(junction / a);
      const double slope = is * rise / a + p[kFitGsh];
      const double factor = 1 / (1 + p[kFitRs] * slope);
      double* const row = jacobian + k * kFitted;
      row[kFitIph] = factor;
      row[kFitLnIs] = -factor * is * (rise - 1);
      row[kFitRs] = -factor * residuals[k] * slope;
      row[kFitGsh] = -factor * junction;
      row[kFitN] = factor * is * rise * junction / (a * p[kFitN]);
    }
    residuals[k] -= current[k];
  }
  return true;
}

bool IsSweep(const IvCurve& curve) {
  return curve.size() >= kLeastReadings && curve.irradiance_known && curve.temperature_known &&
         curve.conditions.irradiance_W_m2 > 0;
}

double Celsius(const IvCurve& curve) {
  return curve.conditions.cell_temperature_K - kZeroCelsius_K;
}

double ThermalAtOne(const IvCurve& curve) {
  return curve.conditions.ModuleThermalVoltage(ConstantSet::kCodata);
}

// Substrings without voltage: what is missing of Voc, if it is near a whole number of them.
int LostSubstrings(const TrendDevice& device, double voc_V, double expected_V) {
  constexpr int kMostTold = 8;        // beyond, one is as small as the errors of a temperature
  constexpr double kNear = 0.35;      // of a substring
  if (device.substrings < 2 || device.substrings > kMostTold) return 0;
  const double lost = device.substrings * (1 - voc_V / expected_V);
  const double whole = std::round(lost);
  if (whole < 1 || whole >= device.substrings || std::fabs(lost - whole) > kNear) return 0;
  return static_cast<int>(whole);
}

}  // namespace

double TrendDevice::ThermalVoltage(double temperature_C) const {
  return n * cells_in_series *
         lyrefit::ThermalVoltage(temperature_C + kZeroCelsius_K, ConstantSet::kCodata);
}

double TrendDevice::SaturationShift(double temperature_C) const {
  const double kelvin = temperature_C + kZeroCelsius_K;
  const double k_eV = lyrefit::ThermalVoltage(1.0, ConstantSet::kCodata);
  return 3 * std::log(kelvin / kReferenceTemperature_K) +
         DeSotoBarrier(bandgap_eV, bandgap_slope_per_K, kReferenceTemperature_K, kelvin, k_eV);
}

double TrendDevice::Photocurrent(double irradiance_W_m2, double temperature_C) const {
  return photocurrent_A * irradiance_W_m2 / kReferenceIrradiance_W_m2 *
         (1 + isc_tempco_per_K * (temperature_C - kReferenceTemperature_C));
}

double TrendDevice::OpenCircuit(double photocurrent, double temperature_C) const {
  return ThermalVoltage(temperature_C) *
         (std::log(photocurrent) - ln_saturation_current - SaturationShift(temperature_C));
}

TrendState StateOf(const TrendDevice& device, const std::array<double, kTrendParameters>& parameters,
                   double expected_A, double temperature_C) {
  const double n = parameters[kTrendIdeality];
  const double voc = device.OpenCircuit(expected_A, temperature_C) + parameters[kTrendVoltage];
  const double a = device.ThermalVoltage(temperature_C) * n / device.n;
  return {expected_A * std::exp(parameters[kTrendLight]),
          std::max(parameters[kTrendSeries], 0.0),
          std::log(expected_A) - voc / a, n, std::max(parameters[kTrendShunt], 0.0)};
}

double PowerOf(const TrendDevice& device, const TrendState& state, double temperature_C) {
  const double is = std::exp(state.ln_saturation_current);
  const double rsh = state.shunt_conductance_S > 0 ? 1 / state.shunt_conductance_S : kInfinity;
  const double a = device.ThermalVoltage(temperature_C) * state.n / device.n;
  double i_sc = 0, v_oc = 0, i_mp = 0, v_mp = 0, p_mp = 0, i_x = 0, i_xx = 0;
  KeyPointsOf(
      DiodeOf(&state.photocurrent_A, &is, &state.resistance_series_ohm, &rsh, &a, 1),
      {&i_sc, &v_oc, &i_mp, &v_mp, &p_mp, &i_x, &i_xx});
  return p_mp;
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
  device.ln_saturation_current = std::log(at(law.saturation_current, 0));
  device.shunt_conductance_S = 1 / at(law.resistance_shunt, kInfinity);
  return device;
}

SweepFit FitSweep(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                  double nNsVth_1, double n) {
  SweepFit out;
  const KeyPoints key = FindKeyPoints(voltage_V, current_A);
  double isc = key.short_circuit_current_A;
  if (!(isc > 0)) isc = *std::max_element(current_A.begin(), current_A.end());
  const double voc = key.open_circuit_voltage_V;
  if (!(isc > 0) || !(voc > 0)) return out;
  const double scale = voc / isc;
  LeastSquaresProblem problem;
  problem.residuals = static_cast<int>(voltage_V.size());
  problem.lower = {0, -150, 0, 0, 0.3};
  problem.upper = {3 * isc, std::log(isc), scale, 10 / scale, 6};
  problem.evaluate = [&](const double* p, double* residuals, double* jacobian) {
    return EvaluateSweep(voltage_V, current_A, nNsVth_1, p, residuals, jacobian);
  };
  const double ln_is = std::log(isc) - voc / (n * nNsVth_1);
  const LeastSquaresEnd end = SolveLeastSquares(
      problem, {isc, ln_is, 0.02 * scale, 1e-3 / scale, n}, UpTo(60, 1e-10));
  if (!end.usable) return out;
  out = {end.p[kFitIph], end.p[kFitRs],  end.p[kFitLnIs],
         end.p[kFitGsh], end.p[kFitN],
         std::sqrt(end.sum_of_squares / static_cast<double>(voltage_V.size())),
         true};
  return out;
}

Expected<TrendDevice> DeviceOfSweeps(const std::vector<const IvCurve*>& sweeps) {
  TrendDevice device;
  std::vector<const IvCurve*> fitted;
  std::vector<SweepFit> fits;
  std::vector<double> n, iph, rs, ln_is, gsh;
  for (const IvCurve* curve : sweeps) {
    if (!IsSweep(*curve)) continue;
    device.cells_in_series = curve->conditions.cells_in_series;
    const DeviceNotes& notes = curve->notes;
    device.substrings = notes.bypass_diodes.value_or(device.substrings);
    device.bandgap_eV = notes.bandgap_eV.value_or(device.bandgap_eV);
    device.bandgap_slope_per_K = notes.bandgap_slope_per_K.value_or(device.bandgap_slope_per_K);
    device.isc_tempco_per_K = notes.isc_tempco_per_K.value_or(device.isc_tempco_per_K);
    const SweepFit fit =
        FitSweep(curve->voltage_V, curve->current_A, ThermalAtOne(*curve), device.n);
    if (!fit.usable) continue;
    fitted.push_back(curve);
    fits.push_back(fit);
    n.push_back(fit.n);
    rs.push_back(fit.resistance_series_ohm);
    gsh.push_back(fit.shunt_conductance_S);
  }
  if (fits.empty()) {
    return Fail(
        "expected sweeps with a stated irradiance and temperature that a single diode describes, "
        "found none among the reference days");
  }
  device.n = Median(n);
  device.resistance_series_ohm = Median(rs);
  device.shunt_conductance_S = Median(gsh);
  for (std::size_t k = 0; k < fits.size(); ++k) {
    // The saturation current that gives the same open-circuit voltage with the common n.
    const double voc = fits[k].n * (std::log(fits[k].photocurrent_A) - fits[k].ln_saturation_current);
    const double celsius = Celsius(*fitted[k]);
    ln_is.push_back(std::log(fits[k].photocurrent_A) - voc / device.n -
                    device.SaturationShift(celsius));
    const double light = fitted[k]->conditions.irradiance_W_m2 / kReferenceIrradiance_W_m2;
    const double warm = 1 + device.isc_tempco_per_K * (celsius - kReferenceTemperature_C);
    iph.push_back(fits[k].photocurrent_A / (light * warm));
  }
  device.photocurrent_A = Median(iph);
  device.ln_saturation_current = Median(ln_is);
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
  row.lost_substrings =
      LostSubstrings(device, row.voc_V, device.OpenCircuit(row.isc_A, row.temperature_C));
  const double left =
      device.substrings > 0
          ? 1 - static_cast<double>(row.lost_substrings) / device.substrings
          : 1;
  const SweepFit fit =
      FitSweep(curve.voltage_V, curve.current_A, ThermalAtOne(curve) * left, device.n);
  if (!fit.usable) {
    row.reason = "no single diode describes it";
    return row;
  }
  const double expected_A = device.Photocurrent(row.irradiance_W_m2, row.temperature_C);
  const double voc =
      fit.n * ThermalAtOne(curve) * (std::log(expected_A) - fit.ln_saturation_current);
  row.parameters = {std::log(fit.photocurrent_A / expected_A), fit.resistance_series_ohm / left,
                    voc - device.OpenCircuit(expected_A, row.temperature_C), fit.n,
                    fit.shunt_conductance_S * left};
  row.misfit = fit.rms_A / row.isc_A;
  row.state = TrendRowState::kUsed;
  return row;
}

}  // namespace lyrefit
