// Complete searches of 100 candidates x 1000 iterations on the MSX-60's triple-diode model, with
// the settings of the modified-lyrebird paper (75 C, its bounds and constants), against the bare
// evaluations.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "bench_support.h"
#include "benchmarks.h"
#include "claims.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/search/search.h"

namespace lyrefit::bench {
namespace {

constexpr int kPopulation = 100;
constexpr int kIterations = 1000;

struct Subject {
  Device device;
  PointSet points;
  Box box;
  ObjectiveFunction objective;  // every parameter on a linear scale, as in the paper
};

std::shared_ptr<Subject> MakeSubject() {
  IvCurve curve = LoadCurve("msx60");
  curve.conditions.cell_temperature_K = kZeroCelsius_K + 75;
  auto subject = std::make_shared<Subject>();
  subject->device = MakeDevice(Model::kTripleDiode, curve.conditions, ConstantSet::kPaper);
  subject->points = MakePointSet(curve.voltage_V, curve.current_A);
  const auto bounds = MakeBounds(LoadBounds("msx60", "paper"), subject->device, curve);
  const std::vector<double> nothing_fixed(subject->device.size(), std::nan(""));
  const SearchSpace space(*bounds, nothing_fixed);
  subject->box = space.box();
  const Subject* s = subject.get();
  subject->objective = [s, space, p = std::vector<double>(nothing_fixed)](const double* x) mutable {
    space.ToParameters(x, p.data());
    return std::sqrt(MeanSquare(s->device, Objective::kMeasuredCurrent, p.data(), s->points));
  };
  return subject;
}

void CompleteSearch(benchmark::State& state, const Subject& subject, Algorithm algorithm) {
  SearchOptions options;
  options.algorithm = algorithm;
  options.population = kPopulation;
  options.iterations = kIterations;
  double evaluations = 0;
  double best = 0;
  for (auto _ : state) {
    const SearchSummary summary = Search(subject.objective, subject.box, options);
    evaluations += static_cast<double>(summary.evaluations);
    best += summary.best.objective;
    ++options.seed;
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["evaluations"] = evaluations / runs;
  state.counters["mean_RMSE_A"] = best / runs;
}

void BareEvaluations(benchmark::State& state, const Subject& subject) {
  constexpr int kDrawn = 4096;
  const std::vector<double> x = DrawParameters(
      MakeCase("msx60", Model::kTripleDiode, LoadBounds("msx60", "paper"), ConstantSet::kPaper),
      kDrawn);
  const std::size_t size = subject.box.lower.size();
  for (auto _ : state) {
    double sum = 0;
    for (int k = 0; k < kPopulation * kIterations; ++k) {
      sum += subject.objective(&x[static_cast<std::size_t>(k % kDrawn) * size]);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.counters["evaluations"] = kPopulation * kIterations;
}

}  // namespace

void RegisterSearchBenchmarks() {
  const std::shared_ptr<Subject> subject = MakeSubject();
  const std::string bare = "100 x 1000 on MSX-60 TD/bare evaluations";
  benchmark::RegisterBenchmark(bare.c_str(), [subject](benchmark::State& state) {
    BareEvaluations(state, *subject);
  })->Unit(benchmark::kMillisecond);
  for (const Algorithm algorithm :
       {Algorithm::kMlo, Algorithm::kLo, Algorithm::kDe, Algorithm::kRandom}) {
    const std::string name = "100 x 1000 on MSX-60 TD/" + ToText(algorithm);
    benchmark::RegisterBenchmark(name.c_str(), [subject, algorithm](benchmark::State& state) {
      CompleteSearch(state, *subject, algorithm);
    })->Unit(benchmark::kMillisecond);
    if (algorithm == Algorithm::kMlo) {
      AddClaim({"complete MLO run 100 x 1000, MSX-60 TD / its bare evaluations",
                name,
                bare,
                2.5,
                false,
                {}});
    }
  }
}

}  // namespace lyrefit::bench
