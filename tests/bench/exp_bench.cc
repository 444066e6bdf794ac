// The portable exponential against the mathematics library's, one number at a time.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "benchmarks.h"
#include "lyrefit/base/portable_exp.h"
#include "lyrefit/base/random.h"

namespace lyrefit::bench {
namespace {

template <class Exp>
void Measure(benchmark::State& state, const Exp& exponential) {
  std::array<double, 1024> x;
  RandomStream random(1);
  for (double& value : x) value = -5 + 35 * random.Uniform();
  for (auto _ : state) {
    double sum = 0;
    for (const double value : x) sum += exponential(value);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(x.size()));
}

void StdExp(benchmark::State& state) {
  Measure(state, [](double x) { return std::exp(x); });
}
void LyrefitExp(benchmark::State& state) {
  Measure(state, [](double x) { return PortableExp(x); });
}

}  // namespace

void RegisterExpBenchmarks() {
  benchmark::RegisterBenchmark("1024 exponentials/std::exp", StdExp);
  benchmark::RegisterBenchmark("1024 exponentials/PortableExp", LyrefitExp);
}

}  // namespace lyrefit::bench
