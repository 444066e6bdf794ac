// One evaluation of the measured-current RMSE: a plain loop over std::exp against every kernel.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "bench_support.h"
#include "benchmarks.h"
#include "claims.h"

namespace lyrefit::bench {
namespace {

constexpr int kSets = 256;  // parameter vectors, used in turn

// Straightforward implementation, as in published codes: a loop over points and diodes, with terms
// independent of the voltage computed before it.
template <int diodes>
double PlainRmse(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                 double module_thermal_voltage_V, const double* p) {
  double saturation[diodes];
  double steepness[diodes];
  for (int d = 0; d < diodes; ++d) {
    saturation[d] = p[SaturationCurrentIndex(d)];
    steepness[d] = 1 / (p[IdealityIndex(d)] * module_thermal_voltage_V);
  }
  const double conductance = 1 / p[kRsh];
  double sum = 0;
  for (std::size_t k = 0; k < voltage_V.size(); ++k) {
    const double vd = voltage_V[k] + current_A[k] * p[kRs];
    double current = p[kIph] - vd * conductance;
    for (int d = 0; d < diodes; ++d) {
      current -= saturation[d] * (std::exp(vd * steepness[d]) - 1);
    }
    const double residual = current - current_A[k];
    sum += residual * residual;
  }
  return std::sqrt(sum / static_cast<double>(voltage_V.size()));
}

template <class Evaluate>
void Measure(benchmark::State& state, const Case& subject, const Evaluate& evaluate) {
  const std::vector<double> parameters = DrawParameters(subject, kSets);
  const int size = subject.device.size();
  int set = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(&parameters[static_cast<std::size_t>(set) * size]));
    set = set + 1 == kSets ? 0 : set + 1;
  }
  state.counters["evaluations/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void Register(const std::string& curve, const std::string& bounds, Model model) {
  const auto subject = std::make_shared<Case>(MakeCase(curve, model, LoadBounds(curve, bounds)));
  const std::string what = "measured RMSE/" + curve + "/" + ModelName(model) + "/";
  benchmark::RegisterBenchmark((what + "std::exp").c_str(), [subject](benchmark::State& state) {
    const double vt = subject->device.module_thermal_voltage_V;
    const auto& v = subject->curve.voltage_V;
    const auto& i = subject->curve.current_A;
    Measure(state, *subject, [&](const double* p) {
      switch (DiodeCount(subject->device)) {
        case 1:
          return PlainRmse<1>(v, i, vt, p);
        case 2:
          return PlainRmse<2>(v, i, vt, p);
        default:
          return PlainRmse<3>(v, i, vt, p);
      }
    });
  });
  for (const Kernel& kernel : AvailableKernels()) {
    benchmark::RegisterBenchmark(
        (what + kernel.name).c_str(), [subject, &kernel](benchmark::State& state) {
          Measure(state, *subject, [&](const double* p) {
            return std::sqrt(MeanSquare(subject->device, Objective::kMeasuredCurrent, p,
                                        subject->points, kernel));
          });
        });
  }
  AddClaim({"RMSE evaluation, " + curve + " " + ModelName(model) + ": std::exp loop / lyrefit",
            what + "std::exp",
            what + FastestKernel().name,
            3.0,
            true,
            {}});
}

}  // namespace

void RegisterKernelBenchmarks() {
  Register("msx60", "paper", Model::kTripleDiode);
  Register("rtc_france", "literature", Model::kSingleDiode);
  Register("rtc_france", "literature", Model::kDoubleDiode);
  Register("rtc_france", "literature", Model::kTripleDiode);
}

}  // namespace lyrefit::bench
