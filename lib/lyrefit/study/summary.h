#pragma once

#include <vector>

#include "lyrefit/study/comparison.h"
#include "lyrefit/study/reference.h"

namespace lyrefit {

// One run as the comparison keeps it until its problem is complete.
struct RunOutcome {
  RunRecord record;
  std::vector<TracePoint> gains;   // the trace without the points that brought nothing; never empty
  std::vector<double> parameters;  // of the run's answer
  std::vector<double> own_parameters;  // of the best candidate's own polish; empty: not kept
};

// The points of `trace` where the best became better, and the last one.
std::vector<TracePoint> KeepGains(const std::vector<TracePoint>& trace);

// Evaluations at the first point at or below `target`; -1: none.
std::int64_t EvaluationsTo(double target, const std::vector<TracePoint>& gains);

// Median over the runs of the best so far, at up to `marks` counts of evaluations evenly spaced in
// the logarithm, from where every run has a value to the end of the longest.
std::vector<MedianPoint> MedianCourse(const std::vector<RunOutcome>& outcomes, int marks = 60);

// The lowest RMSE of all stages of all runs of all algorithms; without parameters where there is no
// run.
BestFound BestOf(const std::vector<std::vector<RunOutcome>>& outcomes);

// `values` must not be empty; all NaN if one is NaN.
RunSpread SpreadOf(std::vector<double> values, double reference);

// Ranks of `values[c][b]`, compared c in run b; empty for fewer than two of either. Infinity
// counts as the largest number.
Ranking RankAll(std::vector<std::vector<double>> values);

// The same with answers that agree within 1e-9 joined, whoever found them.
Ranking RankJoined(const std::vector<std::vector<double>>& values);

// Everything that the runs of one compared say together; fills their evaluations to target, and
// where asked for the parameters they ended at.
AlgorithmResult Summarise(const ComparedAlgorithm& compared, std::vector<RunOutcome>* outcomes,
                          double reference, double target_gap, bool keep_parameters = false);

// Algorithms and rankings of a problem from what each compared has done, by rising number of the
// run. Algorithms without a run are left out; ranks are of the runs that all the others have done.
void SumUpAlgorithms(const std::vector<ComparedAlgorithm>& algorithms, const CompareOptions& options,
                     std::vector<std::vector<RunOutcome>> outcomes, ProblemResult* result);

}  // namespace lyrefit
