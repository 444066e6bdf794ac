#pragma once

#include <vector>

#include "lyrefit/base/seconds.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// State that all algorithms of this module share: population, evaluation count, trace and
// termination. An algorithm is a function that changes the population until `stopped()`.
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

  // Objective at x; NaN becomes infinity. Must not be called once stopped().
  double Evaluate(const double* x) {
    const double value = objective_(x);
    ++summary_.evaluations;
    if (summary_.evaluations >= options_.max_evaluations) Stop(SearchTermination::kEvaluations);
    const std::int64_t since = summary_.evaluations - last_.evaluations;
    if (since >= kAskAfter && since % kAskAfter == 0)
      AskObserver(last_.iteration, options_.iterations);
    return value == value ? value : kInfinity;
  }

  // Count the moves of the hiding phase, and those hiding moves that the diversity strategy
  // replaced.
  void CountHide() { ++hides_; }
  void CountDispersal() { ++dispersals_; }
  std::int64_t hides() const { return hides_; }
  std::int64_t dispersals() const { return dispersals_; }

  void Replace(int candidate, const double* x, double f);

  // Ends iteration `t` of `planned`: extends the trace, calls the observer and checks the criteria
  // of termination.
  void EndIteration(std::int64_t t, std::int64_t planned);

  SearchSummary Finish();

 private:
  // Evaluations within an iteration of a large population after which the observer is asked.
  static constexpr std::int64_t kAskAfter = 1024;

  void AskObserver(std::int64_t t, std::int64_t planned);
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
  std::int64_t trace_step_ = 1;  // iterations between points of the trace
  TracePoint last_;              // of the last finished iteration
  SearchSummary summary_;
};

// The algorithms, each in its own file.
void RunLyrebird(SearchRun* run, const SearchOptions& options);
void RunRandom(SearchRun* run, const SearchOptions& options);
void RunDifferentialEvolution(SearchRun* run, const SearchOptions& options);

// Draws the first population uniformly in the box (Eq. 14) and ends iteration 0. With `initial`, up
// to a quarter of the candidates start at the initial points of the box.
class RandomStream;
void DrawPopulation(SearchRun* run, RandomStream* random, std::int64_t planned,
                    bool initial = false);

// Draws x uniformly in the box.
void DrawPoint(const Box& box, RandomStream* random, double* x);

// Crowding of a population in the unit box: each candidate's mean distance to the others, and the
// largest distance of all. Both are updated after each move. A move costs O(N d), a query O(1), and
// the memory is O(N d), because no distances are stored. The sums are updated by differences. Their
// rounding drift is far below the uncertainty in the choice of the threshold, and the same in every
// run.
class Crowding {
 public:
  // `unit` holds `candidates` rows of `dimensions` unit-box coordinates.
  Crowding(int candidates, int dimensions, const std::vector<double>& unit);

  // Sets the position of candidate `i` to the `dimensions` coordinates at `unit`.
  void Move(int i, const double* unit);

  double MeanDistance(int i) const { return sum_[i] / (candidates_ - 1); }  // Dis_i, Eq. 24
  double LargestDistance() const { return largest_; }                       // Dis_max, Eq. 25

 private:
  void FindDistances(int i, std::vector<double>* distance);
  void FindLargest();
  static int FarthestOf(const std::vector<double>& distance);

  int candidates_;
  int dimensions_;
  int stride_;                      // number of candidates, rounded up to whole vectors
  std::vector<double> coordinate_;  // all candidates' values of dimension 0, then of 1, ...;
                                    // stride_ apart
  std::vector<double> point_;
  std::vector<double> sum_;
  std::vector<double> bound_;  // upper bound of each candidate's distances
  std::vector<double> past_;
  std::vector<double> fresh_;
  double largest_ = 0;
  int end_a_ = 0;  // the two candidates that are farthest apart
  int end_b_ = 0;
};

}  // namespace lyrefit
