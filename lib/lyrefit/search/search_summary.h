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
  kEvaluations,  // evaluation budget used up
  kTarget,       // target reached
  kTimeLimit,
  kPatience,     // no improvement for `patience` iterations
  kInterrupted,  // the observer requested a stop
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
  std::vector<double> x;         // one coordinate for each side of the box
  double objective = kInfinity;  // at x; infinite if not evaluated
};

// The best objective value after an iteration; iteration 0 is the first population.
struct TracePoint {
  std::int64_t iteration = 0;  // from 0
  std::int64_t evaluations = 0;
  double best = kInfinity;  // objective
};

// Result of a search.
struct SearchSummary {
  SearchTermination termination = SearchTermination::kNotRun;
  std::string message;
  Candidate best;
  std::vector<Candidate> elites;  // distinct candidates, best first; the first one is `best`
  std::int64_t evaluations = 0;
  std::int64_t iterations = 0;  // completed
  double seconds = 0;
  // From iteration 0 to the last. A search of more than 65,536 iterations keeps only every second,
  // fourth, eighth, ... iteration, so that no trace exceeds 65,538 points.
  std::vector<TracePoint> trace;
};

// What a side of a box stands for.
struct BoxSide {
  std::string name;     // of the parameter: "saturation_current"; "variant" of effects with several
  std::string unit;     // of the parameter; empty for pure numbers
  double log_base = 0;  // above 0: the coordinate is ln(value / log_base)
  // Above 0: the value of coordinate x is first + step floor(x), a step for each unit of length.
  double step = 0;
  double first = 0;
};

// Bounds of a search, one side for each parameter.
struct Box {
  std::vector<double> lower;
  std::vector<double> upper;
  // Points where a minimum may lie, most likely first; used by kMloShape only. May be empty.
  std::vector<std::vector<double>> initial = {};
  std::vector<BoxSide> sides = {};  // for searches that want to know; may be empty
};

// The function to minimise. It reads as many numbers as the box has sides and must return the same
// value for the same point. NaN counts as infinity.
using ObjectiveFunction = std::function<double(const double*)>;

// A replacement for Search(). It must return the best point, at least one elite, the trace and the
// evaluation count, and the same result for the same seed and run.
using SearchFunction = std::function<SearchSummary(const ObjectiveFunction&, const Box&,
                                                   const SearchOptions&, const Observer&)>;

}  // namespace lyrefit
