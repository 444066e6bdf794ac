#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/search/search_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Why a search ended.
enum class SearchTermination {
  kNotRun,
  kIterations,   // all iterations done
  kEvaluations,  // budget used up
  kTarget,       // target reached
  kTimeLimit,
  kPatience,     // no gain for `patience` iterations
  kInterrupted,  // the observer asked to stop
};

template <>
struct EnumTable<SearchTermination> {
  static constexpr EnumText<SearchTermination> kRows[] = {
      {SearchTermination::kNotRun, "not run"},
      {SearchTermination::kIterations, "iterations"},
      {SearchTermination::kEvaluations, "evaluations"},
      {SearchTermination::kTarget, "target"},
      {SearchTermination::kTimeLimit, "time limit"},
      {SearchTermination::kPatience, "patience"},
      {SearchTermination::kInterrupted, "interrupted"},
  };
};

// A point of the box and its objective value.
struct Candidate {
  std::vector<double> x;         // as many as the box has sides
  double objective = kInfinity;  // at x; infinite where there is none
};

// The best so far after an iteration (iteration 0: the first random candidates).
struct TracePoint {
  std::int64_t iteration = 0;  // from 0
  std::int64_t evaluations = 0;
  double best = kInfinity;  // objective
};

// What a search found, and how it went.
struct SearchSummary {
  SearchTermination termination = SearchTermination::kNotRun;
  std::string message;
  Candidate best;
  std::vector<Candidate> elites;  // distinct candidates, best first; the first one is `best`
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;  // that were done
  double seconds = 0;
  // From iteration 0 to the last one; of a search of more than 65,536 iterations every second,
  // fourth, eighth, ... so that no trace is longer than 65,538 points.
  std::vector<TracePoint> trace;
};

// Between what limits a search looks, a side for each parameter.
struct Box {
  std::vector<double> lower;
  std::vector<double> upper;
  // Places where a minimum may lie, best guess first; only kMloKnees looks at them. May be empty.
  std::vector<std::vector<double>> suggested = {};
};

// The function to minimise: takes as many numbers as the box has sides. Must return the same value
// for the same point; NaN counts as infinity.
using ObjectiveFunction = std::function<double(const double*)>;

// Any search with this signature can take the place of Search(): it must come back with the best
// point, at least one elite, the trace and the count of evaluations, and the same for the same seed
// and run.
using SearchFunction = std::function<SearchSummary(const ObjectiveFunction&, const Box&,
                                                   const SearchOptions&, const Observer&)>;

}  // namespace lyrefit
