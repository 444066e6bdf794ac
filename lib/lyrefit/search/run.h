#pragma once

#include "lyrefit/base/seconds.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// What every algorithm of this module shares: the population, the count of evaluations, the trace and
// the reasons to stop. An algorithm is a function that moves the population until `stopped()`.
class SearchRun {
 public:
  SearchRun(const ObjectiveFunction& objective, const Box& box, const SearchOptions& options,
            const Observer& observer);

  int dimensions() const { return dimensions_; }
  int population() const { return static_cast<int>(f_.size()); }
  const Box& box() const { return box_; }
  double* x(int candidate) { return &x_[static_cast<std::size_t>(candidate) * dimensions_]; }
  double f(int candidate) const { return f_[candidate]; }
  int best() const { return best_; }
  bool stopped() const { return summary_.termination != SearchTermination::kNotRun; }

  // Objective at x, NaN as infinity. Must not be called once stopped().
  double Evaluate(const double* x) {
    const double value = objective_(x);
    ++summary_.evaluations;
    if (summary_.evaluations >= options_.max_evaluations) Stop(SearchTermination::kEvaluations);
    return value == value ? value : kInfinity;
  }

  // Moves of the hiding phase, and those of them that the diversity strategy took.
  void CountHide() { ++hides_; }
  void CountDispersal() { ++dispersals_; }
  std::int64_t hides() const { return hides_; }
  std::int64_t dispersals() const { return dispersals_; }

  void Replace(int candidate, const double* x, double f);

  // Ends iteration `t` of `planned`: adds to the trace, asks the observer, looks at the clock.
  void EndIteration(std::int64_t t, std::int64_t planned);

  SearchSummary Finish();

 private:
  void Stop(SearchTermination why) {
    if (!stopped()) summary_.termination = why;
  }
  double Seconds() const;
  void AddToTrace(const TracePoint& point);
  void AddElite(const double* candidate, double f);
  void CollectElites();

  const ObjectiveFunction& objective_;
  const Box& box_;
  const SearchOptions& options_;
  const Observer& observer_;
  const int dimensions_;
  const Instant begin_ = Now();
  std::vector<double> x_;
  std::vector<double> f_;
  int best_ = 0;
  std::int64_t hides_ = 0;
  std::int64_t dispersals_ = 0;
  double best_at_last_gain_ = kInfinity;
  std::int64_t last_gain_ = 0;
  std::int64_t trace_step_ = 1;  // iterations from one point of the trace to the next
  TracePoint last_;              // of the iteration that ended last
  SearchSummary summary_;
};

// The algorithms, one file each.
void RunLyrebird(SearchRun* run, const SearchOptions& options);
void RunRandom(SearchRun* run, const SearchOptions& options);
void RunDifferentialEvolution(SearchRun* run, const SearchOptions& options);

// Draws the first population uniformly in the box (Eq. 14), up to a quarter of it at the places
// that the box suggests where `suggested`, and ends iteration 0.
class RandomStream;
void DrawPopulation(SearchRun* run, RandomStream* random, std::int64_t planned,
                    bool suggested = false);

// A point of the box, uniformly.
void DrawPoint(const Box& box, RandomStream* random, double* x);

}  // namespace lyrefit
