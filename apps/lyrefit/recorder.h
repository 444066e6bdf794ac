#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "lyrefit/search/search.h"

namespace lyrefit {

// Thrown from an external search when its budget is used up or the observer requests a stop.
struct SearchOver {};

// The objective for an external search, on the unit box. Counts evaluations, keeps the best
// distinct points and the trace, and ends the search exactly at its budget.
class Recorder {
 public:
  Recorder(ObjectiveFunction objective, Box box, const SearchOptions& options, Observer observer);

  // Objective at a point of the unit box; points outside are clamped, NaN becomes infinity. Throws
  // SearchOver instead of exceeding the budget.
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
