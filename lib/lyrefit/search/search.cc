#include "lyrefit/search/search.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/random.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/search/run.h"

namespace lyrefit {
namespace {

// Candidates closer than this in every coordinate of the unit box count as one elite.
constexpr double kDistinct = 0.01;

constexpr std::size_t kLongestTrace = 65537;

std::string Message(const SearchSummary& summary) {
  switch (summary.termination) {
    case SearchTermination::kNotRun:
      return "the search was not run";
    case SearchTermination::kIterations:
      return "all " + std::to_string(summary.iterations) + " iterations done";
    case SearchTermination::kEvaluations:
      return "the budget of " + std::to_string(summary.evaluations) + " evaluations is used up";
    case SearchTermination::kTarget:
      return "the target was reached";
    case SearchTermination::kTimeLimit:
      return "the time limit was reached";
    case SearchTermination::kPatience:
      return "no gain for as many iterations as patience allows";
    case SearchTermination::kInterrupted:
      return "stopped on request; the best so far is reported";
  }
  return "";
}

}  // namespace

SearchRun::SearchRun(const ObjectiveFunction& objective, const Box& box,
                     const SearchOptions& options, const Observer& observer)
    : objective_(objective),
      box_(box),
      options_(options),
      observer_(observer),
      dimensions_(static_cast<int>(box.lower.size())),
      x_(static_cast<std::size_t>(options.population) * box.lower.size()),
      f_(options.population, kInfinity) {}

double SearchRun::Seconds() const { return SecondsSince(begin_); }

void SearchRun::Replace(int candidate, const double* x, double f) {
  std::copy(x, x + dimensions_, this->x(candidate));
  f_[candidate] = f;
  if (f < f_[best_]) best_ = candidate;
}

// Extends the trace. A full trace is halved: every second point is removed, and half as many points
// are recorded from then on.
void SearchRun::AddToTrace(const TracePoint& point) {
  last_ = point;
  if (point.iteration % trace_step_ != 0) return;
  std::vector<TracePoint>& trace = summary_.trace;
  trace.push_back(point);
  if (trace.size() <= kLongestTrace) return;
  trace_step_ *= 2;
  trace.erase(
      std::remove_if(trace.begin(), trace.end(),
                     [this](const TracePoint& p) { return p.iteration % trace_step_ != 0; }),
      trace.end());
}

void SearchRun::EndIteration(std::int64_t t, std::int64_t planned) {
  const double best = f_[best_];
  summary_.iterations = t;
  AddToTrace({t, summary_.evaluations, best});
  if (best < best_at_last_gain_) {
    best_at_last_gain_ = best;
    last_gain_ = t;
  }
  if (best <= options_.target) Stop(SearchTermination::kTarget);
  if (options_.patience > 0 && t - last_gain_ >= options_.patience) {
    Stop(SearchTermination::kPatience);
  }
  if (t >= planned) Stop(SearchTermination::kIterations);
  AskObserver(t, planned);
}

void SearchRun::AskObserver(std::int64_t t, std::int64_t planned) {
  const bool timed = options_.time_limit_s < kInfinity;
  if (!timed && !observer_) return;
  const double seconds = Seconds();
  if (timed && seconds >= options_.time_limit_s) Stop(SearchTermination::kTimeLimit);
  const Progress progress = {"search", t, planned, summary_.evaluations, f_[best_], seconds};
  if (StopRequested(observer_, progress)) Stop(SearchTermination::kInterrupted);
}

// Adds an elite unless there are enough or one is close.
void SearchRun::AddElite(const double* candidate, double f) {
  if (static_cast<int>(summary_.elites.size()) == options_.elites) return;
  const bool distinct =
      std::all_of(summary_.elites.begin(), summary_.elites.end(), [&](const Candidate& taken) {
        for (int j = 0; j < dimensions_; ++j) {
          const double side = box_.upper[j] - box_.lower[j];
          if (std::fabs(candidate[j] - taken.x[j]) > kDistinct * side) return true;
        }
        return false;
      });
  if (distinct) summary_.elites.push_back({{candidate, candidate + dimensions_}, f});
}

void SearchRun::CollectElites() {
  std::vector<int> order(population());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return f_[a] < f_[b]; });
  for (const int candidate : order) AddElite(x(candidate), f_[candidate]);
  summary_.best = summary_.elites.front();
}

SearchSummary SearchRun::Finish() {
  CollectElites();
  if (last_.iteration > summary_.trace.back().iteration) summary_.trace.push_back(last_);
  summary_.message = Message(summary_);
  summary_.seconds = Seconds();
  return std::move(summary_);
}

void DrawPoint(const Box& box, RandomStream* random, double* x) {
  for (std::size_t j = 0; j < box.lower.size(); ++j) {
    x[j] = box.lower[j] + random->Uniform() * (box.upper[j] - box.lower[j]);
  }
}

void DrawPopulation(SearchRun* run, RandomStream* random, std::int64_t planned, bool initial) {
  const Box& box = run->box();
  const int seats = std::min(run->population() / 4, static_cast<int>(box.initial.size()));
  std::vector<double> x(run->dimensions());
  for (int i = 0; i < run->population() && !run->stopped(); ++i) {
    DrawPoint(box, random, x.data());
    if (initial && i < seats) {
      for (std::size_t j = 0; j < x.size(); ++j) {
        x[j] = std::clamp(box.initial[i][j], box.lower[j], box.upper[j]);
      }
    }
    run->Replace(i, x.data(), run->Evaluate(x.data()));
  }
  run->EndIteration(0, planned);
}

std::vector<std::vector<double>> FirstPopulation(const Box& box, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  std::vector<std::vector<double>> points(options.population,
                                          std::vector<double>(box.lower.size()));
  for (std::vector<double>& point : points) DrawPoint(box, &random, point.data());
  return points;
}

SearchSummary Search(const ObjectiveFunction& objective, const Box& box,
                     const SearchOptions& options, const Observer& observer) {
  CHECK(ValidateOptions(options, kSearchOptionTable).has_value());
  CHECK(!box.lower.empty());
  CHECK_EQ(box.lower.size(), box.upper.size());
  CHECK_LE(box.lower.size(), 64U);
  for (std::size_t j = 0; j < box.lower.size(); ++j) CHECK_LE(box.lower[j], box.upper[j]);
  for (const std::vector<double>& place : box.initial) CHECK_EQ(place.size(), box.lower.size());
  SearchRun run(objective, box, options, observer);
  switch (options.algorithm) {
    case Algorithm::kMlo:
    case Algorithm::kLo:
    case Algorithm::kLoMblss:
    case Algorithm::kLoDmlss:
    case Algorithm::kMloVector:
    case Algorithm::kMloShape:
      RunLyrebird(&run, options);
      break;
    case Algorithm::kRandom:
      RunRandom(&run, options);
      break;
    case Algorithm::kDe:
      RunDifferentialEvolution(&run, options);
      break;
  }
  return run.Finish();
}

namespace {

// Draws three different candidates other than `candidate`.
void DrawThree(RandomStream* random, int population, int candidate, int (&three)[3]) {
  for (int k = 0; k < 3; ++k) {
    bool taken;
    do {
      three[k] = static_cast<int>(random->Index(population));
      taken = three[k] == candidate || std::find(three, three + k, three[k]) != three + k;
    } while (taken);
  }
}

}  // namespace

// Differential evolution DE/rand/1/bin (Storn and Price 1997, doi:10.1023/A:1008202821328). Two
// choices of this library: acceptance is greedy and in place, and mutants are clamped to the box,
// as in lyrebird.cc.
void RunDifferentialEvolution(SearchRun* run, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  DrawPopulation(run, &random, options.iterations);
  const Box& box = run->box();
  const int dimensions = run->dimensions();
  std::vector<double> trial(dimensions);
  for (std::int64_t t = 1; !run->stopped(); ++t) {
    for (int i = 0; i < run->population() && !run->stopped(); ++i) {
      int three[3];
      DrawThree(&random, run->population(), i, three);
      const double* a = run->x(three[0]);
      const double* b = run->x(three[1]);
      const double* c = run->x(three[2]);
      const int always = static_cast<int>(random.Index(dimensions));
      for (int j = 0; j < dimensions; ++j) {
        const bool cross = random.Uniform() < options.de_crossover || j == always;
        trial[j] = cross ? a[j] + options.de_scale * (b[j] - c[j]) : run->x(i)[j];
        trial[j] = std::min(std::max(trial[j], box.lower[j]), box.upper[j]);
      }
      const double value = run->Evaluate(trial.data());
      if (value <= run->f(i)) run->Replace(i, trial.data(), value);
    }
    run->EndIteration(t, options.iterations);
  }
}

// Uniform random search, the baseline of every comparison of metaheuristics. Slot i of the
// population keeps the best of its own draws, from which the elites are taken.
void RunRandom(SearchRun* run, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  DrawPopulation(run, &random, options.iterations);
  std::vector<double> x(run->dimensions());
  for (std::int64_t t = 1; !run->stopped(); ++t) {
    for (int i = 0; i < run->population() && !run->stopped(); ++i) {
      DrawPoint(run->box(), &random, x.data());
      const double value = run->Evaluate(x.data());
      if (value < run->f(i)) run->Replace(i, x.data(), value);
    }
    run->EndIteration(t, options.iterations);
  }
}

}  // namespace lyrefit
