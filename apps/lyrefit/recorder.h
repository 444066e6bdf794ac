#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "lyrefit/search/search.h"

namespace lyrefit {

// Thrown out of a foreign search when its budget is used up or the observer asks to stop.
struct SearchOver {};

// The objective as a foreign search sees it, on the unit box: counts, keeps the best distinct
// points and the trace, and ends the search at the very evaluation.
class Recorder {
 public:
  Recorder(ObjectiveFunction objective, Box box, const SearchOptions& options, Observer observer);

  // Objective at a point of the unit box; what lies outside is clamped, NaN is infinity. Throws
  // SearchOver instead of a call beyond the budget.
  double Evaluate(const double* unit);

  int dimensions() const { return static_cast<int>(box_.lower.size()); }
  std::int64_t evaluations() const { return summary_.evaluations; }
  std::int64_t budget() const { return budget_; }

  SearchSummary Finish();

 private:
  void Keep(const double* unit, double value);
  void EndIteration();

  struct Elite {
    std::vector<double> unit;
    double value;
  };

  const ObjectiveFunction objective_;
  const Box box_;
  const SearchOptions options_;
  const Observer observer_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::int64_t budget_;
  std::vector<double> unit_;
  std::vector<double> x_;
  std::vector<Elite> elites_;  // best first
  SearchSummary summary_;
};

}  // namespace lyrefit
