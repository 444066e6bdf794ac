#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/compare_options.h"
#include "lyrefit/study/rank_tests.h"

namespace LYREFIT_PUBLIC lyrefit {

// RMSE in ampere, all of the objective compared. NaN: not asked for. Where effects have several
// forms (law/variants.h) it is times FitReport::variant_penalty, so that the best form has the lowest.
struct RunRecord {
  int run = 0;  // number of the run, which with the seed names its random stream
  double searched_A = kUnknown;
  double plain_polished_A = kUnknown;  // one bounded solve from the best candidate
  double own_polished_A = kUnknown;    // the best candidate's own polish
  double polished_A = kUnknown;        // the hybrid: best of all starts
  std::int64_t evaluations = 0;
  std::int64_t curve_evaluations = 0;  // that those cost; see FitReport
  // Of the search alone, counted in whole iterations; -1: never reached.
  std::int64_t evaluations_to_target = -1;
  double search_seconds = 0;        // of the search alone
  double polish_seconds = 0;        // from all starts
  double plain_seconds = kUnknown;  // of the best candidate's plain solve
  double own_seconds = kUnknown;    // of the best candidate's own polish
  // Of problems that are pooled: where the best candidate's own polish and the hybrid ended, in the
  // order of Reference::parameters. Empty: not kept.
  std::vector<double> own_parameters;
  std::vector<double> parameters;
};

// How a figure scatters over the runs of one compared.
struct RunSpread {
  double min = kUnknown;     // over all runs
  double mean = kUnknown;    // over all runs
  double median = kUnknown;  // over all runs
  double max = kUnknown;     // over all runs
  double std = kUnknown;     // n - 1 in the denominator; 0 for one run
  int within_1e9 = 0;        // runs no more than that far (relative) above the reference
  int within_1e6 = 0;        // the same for 1e-6
};

// A point of the median course of the searches.
struct MedianPoint {
  std::int64_t evaluations = 0;
  double best_A = kUnknown;  // median over the runs of the best so far
};

// What one compared made of one problem.
struct AlgorithmResult {
  std::string name;  // see ComparedAlgorithm
  std::string algorithm;
  SearchOptions search;  // as the runs had them
  AlgorithmKind kind = AlgorithmKind::kSearch;
  SearchVariables candidates = SearchVariables::kAll;
  std::int64_t budget = 0;
  std::vector<RunRecord> runs;
  RunSpread searched;
  RunSpread plain_polished;  // see RunRecord
  RunSpread own_polished;    // see RunRecord
  RunSpread polished;
  int target_hits = 0;                     // runs whose search reached the target
  double expected_evaluations = kUnknown;  // to the target: evaluations of all runs, each up to its
                                           // hit, by hits (Hansen et al. 2021, COCO); NaN: no hit
  double evaluations = 0;                  // mean of a run, as are the seconds
  double curve_evaluations = 0;            // and this
  double search_seconds = 0;               // mean of a run
  double polish_seconds = 0;               // mean of a run
  std::vector<MedianPoint> trace;          // about 60 points, evenly spaced in the logarithm
};

// What the runs are measured against.
struct Reference {
  double rmse_A = kUnknown;
  bool certified = false;  // proved: no parameters within the bounds are lower by 1e-9 or more
  double lower_bound_A = kUnknown;  // proved lower bound, NaN: none
  double floor_A = kUnknown;        // what any number of diodes could reach, NaN: not known
  std::string origin;               // in plain words
  std::vector<double> parameters;   // in the device's order, effects in the units of reports
  bool interrupted = false;         // before there was a proof
  bool by_multistart = false;       // no run came within 1e-6 of the multistart's (best_known.h)
  int points = 0;                   // random points that it polished
  int visits = 0;                   // those that ended within 1e-6 (relative) of the reference
};

// Ranks of the algorithms with the runs as blocks. Empty for fewer than two algorithms or two runs.
struct Ranking {
  Friedman friedman;
  std::vector<RankPair> pairs;  // every pair of algorithms
  // Two algorithms by Wilcoxon's test.
  struct SignedRank {
    int first = 0;   // position among the algorithms
    int second = 0;  // the same
    Wilcoxon test;
    double p_holm = 1;  // over all pairs
  };
  std::vector<SignedRank> signed_ranks;  // every pair
};

// One curve, or set of curves, with one model.
struct ProblemResult {
  std::string curve_name;  // or the set's
  Model model = Model::kSingleDiode;
  std::string bounds_name;  // "physical", "paper", ... or the file's name
  // What it is pooled under (problem_summary.h): the subject's own, else, of a curve with effects, the
  // curve's name. Empty: a plain problem on its own.
  std::string problem;
  Objective objective = Objective::kMeasuredCurrent;
  std::vector<EffectUse> with;
  bool family = false;                  // a joint fit of a set of curves
  std::vector<std::string> parameters;  // keys, in the order of Reference::parameters
  int first_effect = -1;                // where those of the effects begin; -1: none
  Reference reference;
  std::vector<AlgorithmResult> algorithms;  // in the order given
  // Of the runs that every compared has done.
  Ranking searched;
  Ranking polished;  // the hybrid's figures; those within 1e-9 of each other count as equal
  // False where runs, or the proof of the reference, were cut short: only what was done is there,
  // and algorithms without a single run are left out.
  bool complete = true;
};

// Their names, in the order of the results.
inline std::vector<std::string> AlgorithmNames(const ProblemResult& problem) {
  std::vector<std::string> names;
  for (const AlgorithmResult& compared : problem.algorithms) names.push_back(compared.name);
  return names;
}

// Searches compared on one or several problems.
struct Comparison {
  std::string version;
  CompareOptions options;               // what was asked for
  std::vector<ProblemResult> problems;  // curves in the order given, each with all models; those
                                        // without a single run are left out
  std::vector<std::string> doubts;      // of the readings, before any run; see CheckReadings
  double seconds = 0;
  bool interrupted = false;          // some problem is not complete
  std::vector<std::string> remarks;  // on the journal, in plain sentences
  bool journal_lacks_runs = false;   // it could not be written; a remark says why
};

}  // namespace lyrefit
