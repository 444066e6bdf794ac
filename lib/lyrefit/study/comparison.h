// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/compare_options.h"
#include "lyrefit/study/rank_tests.h"

namespace LYREFIT_PUBLIC lyrefit {

// RMSEs of one run in ampere, of the compared objective. NaN: not requested. If effects have
// several model variants (model/variants.h), the RMSE is multiplied by FitReport::variant_penalty.
// The best variant then has the lowest value.
struct RunRecord {
  int run = 0;  // selects, with the seed, the random stream
  double searched_A = kUnknown;
  double plain_polished_A = kUnknown;  // one bounded least-squares solve from the best candidate
  double own_polished_A = kUnknown;    // the best candidate's own polish
  double polished_A = kUnknown;        // the hybrid: best of all starts
  std::int64_t evaluations = 0;
  std::int64_t curve_evaluations = 0;  // evaluations of the whole curve; see FitReport
  // Evaluations of the search alone until the target, counted in whole iterations; -1: never
  // reached.
  std::int64_t evaluations_to_target = -1;
  double search_seconds = 0;        // of the search alone
  double polish_seconds = 0;        // polish from all starts
  double plain_seconds = kUnknown;  // the best candidate's plain solve
  double own_seconds = kUnknown;    // the best candidate's own polish
  // End points of the best candidate's own polish and of the hybrid, in the order of
  // Reference::parameters. Kept only for problems that are summarised; else empty.
  std::vector<double> own_parameters;
  std::vector<double> parameters;
};

// Distribution of a figure over the runs of one algorithm.
struct RunSpread {
  double min = kUnknown;     // smallest value
  double mean = kUnknown;    // arithmetic mean
  double median = kUnknown;  // middle value
  double max = kUnknown;     // largest value
  double std = kUnknown;     // sample standard deviation (n - 1); 0 for one run
  int within_1e9 = 0;        // runs at most 1e-9 (relative) above the reference
  int within_1e6 = 0;        // runs at most 1e-6 (relative) above the reference
};

// A point of the median convergence curve of the searches.
struct MedianPoint {
  std::int64_t evaluations = 0;
  double best_A = kUnknown;  // median over the runs of the best value so far
};

// The results of one algorithm on one problem.
struct AlgorithmResult {
  std::string name;  // see ComparedAlgorithm
  std::string algorithm;
  SearchOptions search;  // settings used by the runs
  bool own = false;      // a search of the user's, ComparedAlgorithm::searcher
  AlgorithmKind kind = AlgorithmKind::kSearch;
  std::int64_t budget = 0;
  std::vector<RunRecord> runs;
  RunSpread searched;
  RunSpread plain_polished;  // see RunRecord
  RunSpread own_polished;    // see RunRecord
  RunSpread polished;
  int target_hits = 0;  // number of runs whose search reached the target
  // Evaluations to the target: those of all runs, each up to its hit, divided by the number of hits
  // (Hansen et al. 2021, COCO); NaN: no hit.
  double expected_evaluations = kUnknown;
  double evaluations = 0;          // mean of a run
  double curve_evaluations = 0;    // mean of a run
  double search_seconds = 0;       // mean of a run
  double polish_seconds = 0;       // mean of a run
  std::vector<MedianPoint> trace;  // about 60 points, evenly spaced in log(evaluations)
};

// The reference that the runs of a problem are compared with.
struct Reference {
  double rmse_A = kUnknown;
  // Proved: no parameters within the bounds are lower by 1e-9 (relative) or more.
  bool certified = false;
  double lower_bound_A = kUnknown;  // proved lower bound, NaN: none
  double floor_A = kUnknown;        // RMSE that no number of diodes can go below, NaN: unknown
  std::string origin;               // description as text
  std::vector<double> parameters;   // in the device's order, effects in reporting units
  bool interrupted = false;         // stopped before a proof was complete
  // Raised lower bound of n of the runs and of the proof; see FitReport. NaN: the bound was not
  // raised, or the problem has effects.
  double steepest_n = kUnknown;
  // The multistart is better than every run by more than 1e-6 (reference.h).
  bool by_multistart = false;
  int points = 0;  // number of random points polished by the multistart
  int visits = 0;  // number of random points that ended within 1e-6 (relative) of the reference
};

// Ranks of the algorithms with the runs as blocks. Empty for fewer than two algorithms or two runs.
struct Ranking {
  Friedman friedman;
  std::vector<RankPair> pairs;  // every pair of algorithms
  // Wilcoxon's test of two algorithms.
  struct SignedRank {
    int first = 0;   // position among the algorithms
    int second = 0;  // position among the algorithms
    Wilcoxon test;
    double p_holm = 1;  // corrected over all pairs
  };
  std::vector<SignedRank> signed_ranks;  // every pair of algorithms
};

// The results for one curve, or set of curves, with one model.
struct ProblemResult {
  std::string curve_name;  // name of the curve or of the set
  Model model = Model::kSingleDiode;
  std::string bounds_name;  // "physical", "paper", ... or the name of the bounds file
  // Name under which devices are summarised (problem_summary.h). It is that of the input; if that
  // is empty and the curve has effects, the curve's name. Empty: a single problem.
  std::string problem;
  Objective objective = Objective::kMeasuredCurrent;
  std::vector<EffectUse> with;
  bool family = false;                  // a joint fit of a set of curves
  std::vector<std::string> parameters;  // keys, in the order of Reference::parameters
  int first_effect = -1;                // position of the first effect parameter; -1: none
  // Those of `parameters` that the searches see as logarithms (Box::sides); empty for a family.
  std::vector<std::string> log_searched;
  Reference reference;
  std::vector<AlgorithmResult> algorithms;  // in the given order
  // Rankings over the runs that every algorithm has done.
  Ranking searched;
  Ranking polished;  // of the hybrid's RMSEs; values within 1e-9 (relative) of each other are equal
  // False if the runs or the proof of the reference were stopped early. The results then cover the
  // finished runs, and algorithms without a run are left out.
  bool complete = true;
};

// Names of a problem's algorithms, in the order of the results.
inline std::vector<std::string> AlgorithmNames(const ProblemResult& problem) {
  std::vector<std::string> names;
  for (const AlgorithmResult& compared : problem.algorithms) names.push_back(compared.name);
  return names;
}

// The results of a comparison of searches on one or several problems.
struct Comparison {
  std::string version;
  CompareOptions options;  // options of the comparison
  // Curves in the given order, each with all models; problems without a run are left out.
  std::vector<ProblemResult> problems;
  // Warnings about the readings, found before any run; see CheckReadings.
  std::vector<std::string> doubts;
  // Algorithms that spent more evaluations than their budget, a sentence each.
  std::vector<std::string> over_budget;
  double seconds = 0;
  bool interrupted = false;          // at least one problem is not complete
  std::vector<std::string> remarks;  // about the journal, as sentences
  bool journal_lacks_runs = false;   // writing the journal failed; a remark states the reason
};

}  // namespace lyrefit
