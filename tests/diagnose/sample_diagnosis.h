#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/model/kernel.h"
#include "report/sample_report.h"

// Diagnoses written by hand, without running the library.
namespace lyrefit {

// One sweep of a module of 36 cells and its operating conditions.
struct SampleSweep {
  std::string name;
  double irradiance_W_m2 = 1000;
  double temperature_C = 25;
  bool dark = false;
  bool up_and_down = false;
  int points = 60;
};

// Adds the sweep. The base model deviates from the data by `misfit(k, voltage, up)` in ampere, the
// extended model by noise.
template <class Misfit>
void AddSampleSweep(const SampleSweep& sweep, Misfit misfit, Diagnosis* diagnosis) {
  Conditions conditions;
  conditions.cells_in_series = 36;
  const Device device = MakeDevice(Model::kSingleDiode, conditions);
  const std::vector<double> p = {5.0e-3 * sweep.irradiance_W_m2, 2e-7, 1.32, 0.31, 210};
  std::vector<double> voltage;
  for (int i = 0; i < sweep.points; ++i) voltage.push_back(21.5 * i / (sweep.points - 1));
  if (sweep.up_and_down) voltage.insert(voltage.end(), voltage.rbegin(), voltage.rend());
  const std::vector<double> current = SolveCurrents(device, p.data(), voltage);
  const int curve = static_cast<int>(diagnosis->curves.size());
  int segment = diagnosis->points.empty() ? 0 : diagnosis->points.back().segment + 1;
  for (int i = 0; i < static_cast<int>(voltage.size()); ++i) {
    if (sweep.up_and_down && i == sweep.points) ++segment;
    DiagnosedPoint point;
    point.curve = curve;
    point.segment = segment;
    point.voltage_V = voltage[i];
    point.sigma_A = 1e-3 + 1e-3 * std::abs(current[i]);
    point.current_A = current[i] + point.sigma_A * std::sin(2.1 * i * i + curve);
    point.after_A = current[i];
    const bool up = !sweep.up_and_down || i < sweep.points;
    point.before_A = current[i] + misfit(i, voltage[i], up);
    point.time_s = kUnknown;
    diagnosis->points.push_back(point);
  }
  diagnosis->curves.push_back({sweep.name, sweep.irradiance_W_m2, sweep.temperature_C, sweep.dark,
                               static_cast<int>(voltage.size())});
}

inline Trial SampleTrial(const std::string& id, const std::string& title, double rmse_A, double p) {
  Trial trial;
  trial.effect = id;
  trial.title = title;
  trial.tried = true;
  trial.rmse_A = rmse_A;
  trial.misfit = 5e-2 / rmse_A;
  trial.log_evidence = -std::log(p);
  trial.probability = std::max(0.0, 1 - 20 * p);
  trial.delta_aicc = 2 + 20 * std::log10(p);
  trial.held_out_rmse_A = 1.1 * rmse_A;
  trial.kept = 0.42;
  trial.parameters = {{"k", "strength", "A/V", 0.0123, 0.0101, 0.0145, false}};
  return trial;
}

inline Trial SampleUntried(const std::string& id, const std::string& title,
                           const std::string& why_not) {
  Trial trial;
  trial.effect = id;
  trial.title = title;
  trial.why_not = why_not;
  return trial;
}

// Fields that all sample diagnoses share.
inline Diagnosis SampleDiagnosisHead() {
  Diagnosis d;
  d.version = "1.2.3";
  d.name = "sample_module";
  d.source = "data/sample_module.csv";
  d.base = "sd";
  d.base_sentence = "one diode, a linear shunt and a series resistance under steady conditions";
  d.seed = 7;
  d.evidence.kind = "one sweep from 0 V to beyond Voc";
  d.evidence.noise_constant_A = 1e-3;
  d.evidence.noise_relative = 1e-3;
  d.evidence.misfit_ratio = 6.2;
  d.evidence.autocorrelation = 0.12;
  d.evidence.grid_step_A = 1e-3;
  d.evidence.residuals = {4.1e-2, 12.3, 1e-5, 9, 30.5, 1.2e-6, 0.31};
  d.evidence.whiteness_p_value = 3.4e-9;
  d.evidence.whiteness_after_p_value = 0.43;
  d.evidence.findings = {{"runs", "neighbouring residuals go together: 9 runs, 30.5 expected", {}},
                         {"grid", "the currents lie on a grid of 1 mA", {3, 4}}};
  d.trials = {
      SampleTrial("nonohmic_shunt", "non-ohmic shunt", 9.1e-3, 0.02),
      SampleTrial("irr_step", "step of the irradiance", 2.1e-3, 1e-8),
      SampleTrial("drift", "drift of the irradiance", 2.2e-3, 3e-8),
      SampleUntried("capacitance", "capacitance of the junction",
                    "needs sweeps in both directions"),
      SampleUntried("instrument_lag", "lag of the instrument", "needs sweeps in both directions")};
  d.verdict.lack_of_fit = {0.0046, 0.002, 0.0072};
  d.verdict.remaining = {0.0004, 0.0002, 0.0006};
  d.verdict.comparison =
      "0.04 % of Isc with the cause, 0.46 without; healthy modules 0.05 to 0.20 %";
  d.verdict.not_shown = "dirt or slight ageing of all cells alike or resistance of the leads";
  d.verdict.cannot_be_excluded = {
      {"lead_resistance", "Rs", "resistance of leads and contacts counts as Rs",
       "four-wire connection"},
      {"temperature_error", "n, Is1", "an error of the temperature sensor counts as ideality",
       "a second condition"}};
  d.gain.rmse_before_A = 1.31e-2;
  d.gain.rmse_after_A = 2.1e-3;
  d.gain.held_out_before_A = 1.52e-2;
  d.gain.held_out_after_A = 2.4e-3;
  d.gain.held_out_gain_A2 = 2.25e-4;
  d.gain.held_out_gain_error_A2 = 3.1e-5;
  d.gain.gain = true;
  d.gain.folds = 10;
  d.gain.sentence = "On readings that were not fitted the error falls by 84 %.";
  d.gain.shifts = {{"Iph", "photocurrent", "A", 5.061, 5.001, 2e-3},
                   {"n1", "n", "", 1.52, 1.32, 0.021},
                   {"Rs", "resistance_series", "ohm", 0.262, 0.31, 4e-3},
                   {"Rsh", "resistance_shunt", "ohm", 141, 210, 12},
                   {"Pmax", "max_power", "W", 83.1, 82.25, kUnknown}};
  d.extended = SampleReport();
  d.non_default_options = {{"seed", "7", "1"}};
  d.seconds = 1.2;
  return d;
}

inline Cause SampleStepCause() {
  Cause cause;
  cause.id = "irr_step";
  cause.title = "step of the irradiance";
  cause.sentence = "the light jumped while the curve was taken: a cloud edge, a lamp";
  cause.in_words = {"from 12 V on the light was 1.9 % (1.7 to 2.1) weaker than before"};
  cause.current_effect = {0.0046, 0.0041, 0.0051};
  cause.power_effect = {0.0103, 0.0081, 0.0125};
  cause.group = "sweep";
  cause.action = "repeat the sweep under steady light with a reference cell beside the module";
  cause.equivalents = {"drift"};
  cause.separate_by = {"a reference cell read with every point"};
  cause.strength = {{"d", "relative_step", "", -0.019, -0.0212, -0.0168, false},
                    {"V1", "from", "V", 12.1, 11.8, 12.4, true}};
  cause.effect = cause.id;
  cause.evidence = "fit";
  cause.acts = "from the moment of the step on";
  return cause;
}

// A shaded substring with the probabilities of what it could be, and its power.
inline Cause SampleShadingCause() {
  Cause cause;
  cause.id = "shading";
  cause.title = "partial shading";
  cause.sentence = "part of the module gets less light, and its bypass diodes conduct";
  cause.in_words = {"1 of 3 substrings under 71 % (69 to 73) of the others' light"};
  cause.current_effect = {0.062, 0.058, 0.066};
  cause.power_effect = {0.041, 0.035, 0.047};
  cause.recoverable_power_W = {16.7, 15.1, 18.3};
  cause.probability = 0.86;
  cause.alternatives = {{"weak_cell", "weak cells", 0.12},
                        {"irr_step", "step of the irradiance", 0.014}};
  cause.group = "device";
  cause.action = "look for shade, snow or dirt on the darker part and clear it";
  cause.fact_sheet = "PVFS 3-3";
  cause.separate_by = {"repeat the sweep: shading stays at the same voltage",
                       "a thermal image under load"};
  cause.strength = {{"d", "light_deficit", "", 0.29, 0.27, 0.31, false},
                    {"w", "share", "", 1.0 / 3, kUnknown, kUnknown, false}};
  cause.effect = cause.id;
  cause.evidence = "fit";
  cause.acts = "at a step of the current, at a fixed voltage";
  return cause;
}

inline DeviceFinding SampleLeak() {
  return {"leak",
          "Voc/(Rsh Isc)",
          {0.031, 0.029, 0.033},
          0.016,
          0.04,
          "leaks 3.1 % (2.9 to 3.3) of Isc at Voc, twice what healthy modules do (at most 1.6 %)"
          ": -4.0 % of Pmax; potential-induced degradation, a shunted cell or an edge",
          false,
          {10.2, 9.2, 11.3}};
}

// One sweep with an irradiance step, which was found.
inline Diagnosis SampleDiagnosis() {
  Diagnosis d = SampleDiagnosisHead();
  AddSampleSweep(
      {"sample_module"},
      [](int, double voltage, bool) {
        return 0.04 * (voltage < 12 ? 0.6 : -1) * (1 - 0.03 * voltage);
      },
      &d);
  Cause cause = SampleStepCause();
  for (int i = 32; i < 50; ++i) cause.points.push_back(i);
  d.verdict.found = true;
  d.verdict.causes = {cause};
  d.verdict.sentence = "The light stepped down by 1.9 % during the sweep.";
  return d;
}

inline Diagnosis SampleUpDown() {
  Diagnosis d = SampleDiagnosisHead();
  d.name = "up_down";
  d.evidence.kind = "up and down";
  AddSampleSweep(
      {"up_down", 1000, 25, false, true},
      [](int, double voltage, bool up) {
        const double knee = std::exp(-0.25 * (voltage - 17) * (voltage - 17));
        return (up ? 0.08 : -0.08) * knee + 0.012 * std::exp(-0.5 * voltage);
      },
      &d);
  Cause lag = SampleStepCause();
  lag.id = "capacitance";
  lag.title = "capacitance of the junction";
  for (int i = 40; i < 58; ++i) lag.points.push_back(i);
  for (int i = 62; i < 80; ++i) lag.points.push_back(i);
  Cause shunt = SampleStepCause();
  shunt.id = "nonohmic_shunt";
  shunt.title = "non-ohmic shunt";
  for (int i = 0; i < 8; ++i) shunt.points.push_back(i);
  for (int i = 112; i < 120; ++i) shunt.points.push_back(i);
  d.verdict.found = true;
  d.verdict.causes = {lag, shunt};
  d.verdict.sentence = "The sweep was too fast for the junction, and the shunt is not linear.";
  return d;
}

// Curves under `curves` irradiances.
inline Diagnosis SampleDiagnosisOfFamily(int curves) {
  Diagnosis d = SampleDiagnosisHead();
  d.name = "sample_family";
  d.evidence.kind = "a family over irradiance and temperature";
  for (int i = 0; i < curves; ++i) {
    const double irradiance = 200 + 800.0 * i / (curves - 1);
    AddSampleSweep(
        {"sweep-" + std::to_string(i), irradiance, 25.0 + 5 * i, false, false, 40},
        [i](int, double voltage, bool) {
          return 0.01 * i * (1 - voltage / 12) * std::exp(-0.02 * voltage);
        },
        &d);
  }
  Cause cause = SampleStepCause();
  cause.id = "irradiance_error";
  cause.title = "error of the irradiance sensor";
  for (int i = 0; i < static_cast<int>(d.points.size()); ++i) {
    if (d.points[i].curve == curves - 1 && d.points[i].voltage_V < 8) cause.points.push_back(i);
  }
  d.verdict.found = true;
  d.verdict.causes = {cause};
  d.verdict.sentence = "The irradiance sensor reads 1.9 % too high.";
  return d;
}

// A lit and a dark curve with a misfit that no cause explains.
inline Diagnosis SampleLitAndDark() {
  Diagnosis d = SampleDiagnosisHead();
  d.name = "lit_and_dark";
  d.evidence.kind = "a lit and a dark curve";
  d.evidence.noise_dark_A = 2e-4;
  const auto misfit = [](int k, double, bool) { return 0.015 * std::sin(0.3 * k); };
  AddSampleSweep({"lit"}, misfit, &d);
  AddSampleSweep({"dark", 0, 25, true}, misfit, &d);
  d.verdict.sentence = "Something is there, but none of the known causes fits.";
  d.verdict.comparison.clear();
  for (DiagnosedPoint& point : d.points) point.after_A = point.before_A;
  d.evidence.whiteness_after_p_value = d.evidence.whiteness_p_value;
  d.gain = {};
  d.gain.rmse_before_A = d.gain.rmse_after_A = 1.31e-2;
  d.gain.sentence = "nothing to gain";
  return d;
}

}  // namespace lyrefit
