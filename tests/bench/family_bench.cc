// Joint fits of families of curves on one thread: their stages, and whole reports.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "benchmarks.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/family/fit_individually.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit::bench {
namespace {

// `curves` synthetic curves of 50 points of the constructed S75 module, over the irradiances and
// temperatures of a day.
CurveSet SyntheticFamily(int curves) {
  TranslationSpec spec;
  spec.cells_in_series = 36;
  const Translation translation = *MakeTranslation(spec);
  const std::vector<double> shared = {4.715, 6.35e-10, 1.03, 0.282, 85.8, 0.002, 1.0386, -2.677e-4};
  CurveSet set;
  for (int c = 0; c < curves; ++c) {
    IvCurve curve;
    curve.name = std::to_string(c);
    curve.conditions.cells_in_series = 36;
    curve.conditions.irradiance_W_m2 = 150 + 900.0 * c / curves;
    curve.conditions.cell_temperature_K = 288.15 + 45.0 * ((7 * c) % curves) / curves;
    const TranslatedDevice at = TranslateTo(translation, shared, curve.conditions.irradiance_W_m2,
                                            curve.conditions.cell_temperature_K);
    const double voc = ModelKeyPoints(at.device, at.parameters.data()).open_circuit_voltage_V;
    constexpr int kPoints = 50;
    for (int k = 0; k < kPoints; ++k) curve.voltage_V.push_back(voc * k / (kPoints - 1));
    curve.current_A = SolveCurrents(at.device, at.parameters.data(), curve.voltage_V);
    for (int k = 0; k < kPoints; ++k) curve.current_A[k] += 0.002 * ((k * 7919) % 11 - 5) / 5.0;
    set.curves.push_back(std::move(curve));
  }
  return set;
}

void JointFit(benchmark::State& state, int curves, FamilyOptions options) {
  const CurveSet set = SyntheticFamily(curves);
  options.threads = 1;
  for (auto _ : state) {
    const auto report = FitFamily(set, options);
    if (!report || report->refine.termination != "converged") state.SkipWithError("no joint fit");
    benchmark::DoNotOptimize(report);
  }
}

void IndividualFits(benchmark::State& state, int curves) {
  const CurveSet set = SyntheticFamily(curves);
  FamilyOptions options;
  options.threads = 1;
  options.intervals = false;
  for (auto _ : state) benchmark::DoNotOptimize(FitIndividually(set, options));
}

}  // namespace

void RegisterFamilyBenchmarks() {
  FamilyOptions bare;
  bare.individual_fits = bare.intervals = bare.random_baseline = false;
  bare.folds = 0;
  FamilyOptions sensors = bare;
  sensors.irradiance_accuracy = 0.02;
  sensors.temperature_accuracy_K = 1;
  for (const int curves : {7, 30, 300}) {
    const std::string name = "Family of " + std::to_string(curves) + " curves/";
    const auto add = [&](const char* what, const FamilyOptions& options) {
      benchmark::RegisterBenchmark((name + what).c_str(), JointFit, curves, options)
          ->Unit(benchmark::kMillisecond);
    };
    add("joint fit alone", bare);
    add("with an offset of every sensor reading", sensors);
    add("the whole report", {});
    benchmark::RegisterBenchmark((name + "one by one").c_str(), IndividualFits, curves)
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace lyrefit::bench
