#pragma once

#include <vector>

#include "lyrefit/study/comparison.h"
#include "lyrefit/study/reference.h"

namespace lyrefit {

// One run as the comparison stores it until its problem is complete.
struct RunOutcome {
  RunRecord record;
  // The points of the trace with an improvement, and the last one; never empty.
  std::vector<TracePoint> gains;
  std::vector<double> parameters;  // end point of the run
  // End point of the best candidate's own polish; empty: not kept.
  std::vector<double> own_parameters;
};

// The points of `trace` at which the best value improved, and the last one.
std::vector<TracePoint> KeepGains(const std::vector<TracePoint>& trace);

// Number of evaluations at the first point at or below `target`; -1: none.
std::int64_t EvaluationsTo(double target, const std::vector<TracePoint>& gains);

// Median over the runs of the best value so far. It is given at up to `marks` counts of
// evaluations, evenly spaced in the logarithm. They reach from the first count at which every run
// has a value to the end of the longest run.
std::vector<MedianPoint> MedianCourse(const std::vector<RunOutcome>& outcomes, int marks = 60);

// The lowest RMSE of all stages of all runs of all algorithms. Without runs its parameters are
// empty.
BestFound BestOf(const std::vector<std::vector<RunOutcome>>& outcomes);

// `values` must not be empty. All results are NaN if one value is NaN.
RunSpread SpreadOf(std::vector<double> values, double reference);

// Ranks of `values[c][b]`, the value of algorithm c in run b. Empty for fewer than two algorithms
// or runs. Infinity counts as the largest number.
Ranking RankAll(std::vector<std::vector<double>> values);

// RankAll after values within 1e-9 (relative) of each other are made equal, over all algorithms.
Ranking RankJoined(const std::vector<std::vector<double>>& values);

// Summary of all runs of one algorithm. It sets the evaluations to target in `outcomes`, and the
// end parameters if `keep_parameters`.
AlgorithmResult Summarise(const ComparedAlgorithm& compared, std::vector<RunOutcome>* outcomes,
                          double reference, double target_gap, bool keep_parameters = false);

// The problem with its algorithms and rankings. `outcomes[c]` holds the runs of algorithm c by
// increasing run number. Algorithms without a run are left out. Rankings cover only the runs that
// all remaining algorithms have done.
ProblemResult WithAlgorithms(ProblemResult result, const std::vector<ComparedAlgorithm>& algorithms,
                             const CompareOptions& options,
                             std::vector<std::vector<RunOutcome>> outcomes);

}  // namespace lyrefit
