// The current at 1000 terminal voltages: the scalar solver point by point against the vectorised
// solver.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "bench_support.h"
#include "benchmarks.h"
#include "claims.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit::bench {
namespace {

constexpr int kPoints = 1000;

struct Subject {
  Device device;
  std::vector<double> p;
  std::vector<double> voltage_V;
};

// A 57 mm silicon cell with parameters near its least-squares fit, from slight reverse bias to just
// beyond Voc.
Subject MakeSubject(Model model) {
  Subject subject;
  subject.device = MakeDevice(model, LoadCurve("rtc_france").conditions);
  subject.p = {0.7608, 2.26e-7, 1.451, 0.0367, 55.5, 7.0e-7, 1.95, 1.0e-8, 1.3};
  if (model == Model::kSingleDiode) subject.p = {0.7608, 3.2e-7, 1.481, 0.0364, 53.7};
  subject.p.resize(subject.device.size());
  for (int k = 0; k < kPoints; ++k) subject.voltage_V.push_back(-0.1 + 0.7 * k / (kPoints - 1));
  return subject;
}

void Scalar(benchmark::State& state, const Subject& subject) {
  std::vector<double> current(kPoints);
  for (auto _ : state) {
    for (int k = 0; k < kPoints; ++k) {
      current[k] =
          SolveOperatingPoint(subject.device, subject.p.data(), subject.voltage_V[k]).current_A;
    }
    benchmark::DoNotOptimize(current.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kPoints);
}

void Vectorised(benchmark::State& state, const Subject& subject, const Kernel& kernel) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        SolveCurrents(subject.device, subject.p.data(), subject.voltage_V, kernel));
  }
  state.SetItemsProcessed(state.iterations() * kPoints);
}

void Register(Model model) {
  const auto subject = std::make_shared<Subject>(MakeSubject(model));
  const std::string what = "1000 solved currents/" + ModelName(model) + "/";
  benchmark::RegisterBenchmark((what + "scalar").c_str(),
                               [subject](benchmark::State& state) { Scalar(state, *subject); });
  for (const Kernel& kernel : AvailableKernels()) {
    benchmark::RegisterBenchmark(
        (what + kernel.name).c_str(),
        [subject, &kernel](benchmark::State& state) { Vectorised(state, *subject, kernel); });
  }
  AddClaim({"solved current, " + ModelName(model) + ": scalar / vectorised",
            what + "scalar",
            what + FastestKernel().name,
            4.0,
            true,
            {}});
}

}  // namespace

void RegisterSolverBenchmarks() {
  Register(Model::kSingleDiode);
  Register(Model::kDoubleDiode);
  Register(Model::kTripleDiode);
}

}  // namespace lyrefit::bench
