// RTC France to the proved optimum on one thread: the default search and polish, with and without
// intervals, and two optimization libraries with equal box and kernels. Peers with the flag `told`
// get the optimum and stop as soon as they reach it; lyrefit and the other peers do not.

#include <benchmark/benchmark.h>
#include <time.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench_support.h"
#include "benchmarks.h"
#include "claims.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/model_points.h"
#include "peer.h"

namespace lyrefit::bench {
namespace {

constexpr int kRuns = 50;
constexpr int kPeerRuns = 20;

// Processor time of this thread, which is independent of other processes.
double ProcessorSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Milliseconds of every run and how many runs came within 1e-9 of the optimum.
class Tally {
 public:
  explicit Tally(double certified) : certified_(certified) {}

  void Begin() { begin_ = ProcessorSeconds(); }
  void End(double rmse) {
    milliseconds_.push_back(1e3 * (ProcessorSeconds() - begin_));
    hits_ += IsHit(rmse, certified_);
  }
  void Report(benchmark::State& state) const {
    state.counters["hits"] = hits_;
    state.counters["runs"] = static_cast<double>(milliseconds_.size());
    state.counters["median_ms"] = Median(milliseconds_);
  }

 private:
  double certified_;
  int hits_ = 0;
  std::vector<double> milliseconds_;
  double begin_ = 0;
};

void CompleteFit(benchmark::State& state, const IvCurve& curve, Model model, Objective objective,
                 Intervals intervals) {
  FitOptions options;
  options.model = model;
  options.objective = objective;
  options.intervals = intervals;
  options.random_baseline = false;  // the peers compute none either
  options.threads = 1;
  Tally tally(CertifiedRmse(model, objective));
  double search_s = 0, polish_s = 0, interval_s = 0, evaluations = 0;
  for (auto _ : state) {
    tally.Begin();
    const Expected<FitReport> report = Fit(curve, options);
    tally.End(report ? report->rmse.refined.Of(objective) : kInfinity);
    ++options.search.seed;
    if (!report) continue;
    search_s += report->search.seconds;
    polish_s += report->refine.seconds;
    interval_s += report->interval_seconds;
    evaluations += static_cast<double>(report->search.evaluations);
  }
  tally.Report(state);
  const double stages = search_s + polish_s + interval_s;
  state.counters["search_part"] = search_s / stages;
  state.counters["polish_part"] = polish_s / stages;
  if (intervals != Intervals::kNone) state.counters["interval_part"] = interval_s / stages;
  state.counters["evaluations"] = evaluations / static_cast<double>(state.iterations());
}

template <class Run>
void CompletePeer(benchmark::State& state, const Case& subject, Model model, Objective objective,
                  const Run& run) {
  const PeerProblem problem(subject, model, objective);
  Tally tally(CertifiedRmse(model, objective));
  std::uint64_t seed = 0;
  double evaluations = 0;
  for (auto _ : state) {
    tally.Begin();
    const PeerEnd end = run(problem, seed++);
    tally.End(1e-3 * end.rmse_mA);
    evaluations += static_cast<double>(end.evaluations);
  }
  tally.Report(state);
  state.counters["evaluations"] = evaluations / static_cast<double>(state.iterations());
}

// A long sweep under wandering irradiance, with voltage noise larger than the voltage steps.
IvCurve LongSweep(int readings) {
  IvCurve curve;
  curve.conditions.cells_in_series = 72;
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const std::vector<double> truth = {8, 5e-10, 1.01, 0.1, 3000};
  for (int k = 0; k < readings; ++k) curve.voltage_V.push_back(44.0 * k / (readings - 1));
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  RandomStream random(1);
  const double kept = std::exp(-1.0 / readings);
  double light = 0;
  for (int k = 0; k < readings; ++k) {
    light = kept * light + std::sqrt(1 - kept * kept) * random.Normal();
    curve.current_A[k] = curve.current_A[k] * (1 + 1e-3 * light) + 1e-3 * random.Normal();
    curve.voltage_V[k] *= 1 + 3e-4 * random.Normal();
  }
  return curve;
}

void LongFit(benchmark::State& state, const ErrorSpec& errors) {
  const IvCurve curve = LongSweep(static_cast<int>(state.range(0)));
  FitOptions options;
  options.errors = errors;
  options.random_baseline = false;
  options.threads = 1;
  for (auto _ : state) {
    const Expected<FitReport> report = Fit(curve, options);
    if (!report || !report->usable) state.SkipWithError("not fitted");
  }
}

template <class Body>
void RegisterRuns(const std::string& name, int runs, const Body& body) {
  benchmark::RegisterBenchmark(name.c_str(), body)->Iterations(runs)->Unit(benchmark::kMillisecond);
}

void Register(Model model, Objective objective) {
  const auto subject = std::make_shared<Case>(MakeCase("rtc_france", model));
  const std::string row = ModelName(model) + "/" + ObjectiveName(objective);
  const std::string what = "RTC France to 1e-9/" + row + "/";
  RegisterRuns(what + "lyrefit", kRuns, [=](benchmark::State& state) {
    CompleteFit(state, subject->curve, model, objective, Intervals::kNone);
  });
  RegisterRuns(what + "lyrefit with intervals", kRuns, [=](benchmark::State& state) {
    CompleteFit(state, subject->curve, model, objective, Intervals::kProfile);
  });
  const auto peer = [&](const std::string& name, const auto& run, double target) {
    RegisterRuns(what + name, kPeerRuns, [=](benchmark::State& state) {
      CompletePeer(state, *subject, model, objective, run);
    });
    AddClaim({"RTC France " + row + ": " + name + " / lyrefit",
              what + name,
              what + "lyrefit",
              target,
              true,
              {what + "lyrefit"}});
  };
  const auto nlopt = [=](bool told) {
    return [=](const PeerProblem& problem, std::uint64_t seed) {
      return RunNlopt(problem, seed, TunedNlopt(model, objective, told));
    };
  };
  peer("NLopt CRS2+SLSQP", nlopt(false), 2);
  peer(
      "NLopt CRS2+SLSQP, one setting for all",
      [=](const PeerProblem& problem, std::uint64_t seed) {
        return RunNlopt(problem, seed, UniformNlopt(model));
      },
      2);
  peer("NLopt CRS2+SLSQP, told", nlopt(true), 0);
  peer(
      "pagmo2 de1220, told",
      [=](const PeerProblem& problem, std::uint64_t seed) {
        return RunPagmo(problem, seed, TunedPagmo(model));
      },
      2);
  AddClaim({"RTC France " + row + ": with intervals / without",
            what + "lyrefit with intervals",
            what + "lyrefit",
            0,
            false,
            {}});
}

}  // namespace

void RegisterFitBenchmarks() {
  const ErrorSpec field = {ErrorKind::kField, {}, "field"};
  for (const auto& [name, errors] : {std::pair("white", ErrorSpec()), std::pair("field", field)}) {
    const std::string row = std::string("long sweep, errors ") + name;
    benchmark::RegisterBenchmark(row.c_str(), LongFit, errors)
        ->Arg(1000)
        ->Arg(10000)
        ->Arg(100000)
        ->Unit(benchmark::kMillisecond);
  }
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    Register(model, Objective::kMeasuredCurrent);
    Register(model, Objective::kSolvedCurrent);
  }
}

}  // namespace lyrefit::bench
