// Diagnoses on one thread: a sweep of 100 readings with the whole catalogue, and a family.

#include <benchmark/benchmark.h>

#include <string>

#include "benchmarks.h"
#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit::bench {
namespace {

// A synthetic 60-cell module with 0.1 % noise. `step`: relative change of the irradiance in the
// middle of the sweep.
IvCurve SyntheticCurve(double irradiance_W_m2, double temperature_K, int points, double step) {
  TranslationSpec spec;
  spec.shunt = ShuntLaw::kConstant;
  spec.cells_in_series = 60;
  const Translation translation = *MakeTranslation(spec);
  const std::vector<double> shared = {8.6, 6e-10, 1.08, 0.3, 250, 0.0045, 1.121, 0};
  const TranslatedDevice at = TranslateTo(translation, shared, irradiance_W_m2, temperature_K);
  const double voc = ModelKeyPoints(at.device, at.parameters.data()).open_circuit_voltage_V;
  IvCurve curve;
  curve.name = std::to_string(irradiance_W_m2) + " " + std::to_string(temperature_K);
  curve.conditions = {temperature_K, irradiance_W_m2, 60, 1};
  curve.notes.bypass_diodes = 3;
  curve.notes.bandgap_eV = 1.121;
  curve.notes.isc_tempco_per_K = 0.0045 / 8.6;
  for (int k = 0; k < points; ++k) curve.voltage_V.push_back(1.02 * voc * k / (points - 1));
  curve.current_A = SolveCurrents(at.device, at.parameters.data(), curve.voltage_V);
  RandomStream random(17, static_cast<std::uint64_t>(irradiance_W_m2 + temperature_K));
  for (int k = 0; k < points; ++k) {
    if (2 * k > points) curve.current_A[k] *= 1 + step;
    curve.current_A[k] += 0.0086 * random.Normal();
  }
  return curve;
}

void Run(benchmark::State& state, const CurveSet& set, bool held_out) {
  DiagnoseOptions options;
  options.threads = 1;
  options.held_out = held_out;
  for (auto _ : state) {
    const auto diagnosis = Diagnose(set, options);
    if (!diagnosis) state.SkipWithError("no diagnosis");
    benchmark::DoNotOptimize(diagnosis);
  }
}

}  // namespace

void RegisterDiagnoseBenchmarks() {
  CurveSet clean, step, family;
  clean.curves = {SyntheticCurve(1000, 298.15, 100, 0)};
  step.curves = {SyntheticCurve(1000, 298.15, 100, 0.02)};
  for (int c = 0; c < 15; ++c) {
    family.curves.push_back(SyntheticCurve(200 + 200 * (c % 5), 288.15 + 20 * (c / 5), 30, 0));
  }
  const auto add = [](const char* name, const CurveSet& set) {
    for (const bool held_out : {false, true}) {
      benchmark::RegisterBenchmark(
          (std::string("Diagnose/") + name + (held_out ? ", gain held out" : "")).c_str(), Run, set,
          held_out)
          ->Unit(benchmark::kMillisecond);
    }
  };
  add("clean sweep of 100", clean);
  add("sweep of 100 with a step", step);
  add("family of 15 x 30", family);
}

}  // namespace lyrefit::bench
