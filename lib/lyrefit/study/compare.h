#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/option.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/fit/fit.h"
#include "lyrefit/search/search.h"
#include "lyrefit/study/landscape.h"
#include "lyrefit/study/rank_tests.h"

namespace lyrefit {

// What of the hybrid a contender is about.
enum class ContenderKind {
  kSearch,   // a search; what becomes of its birds is looked at by how far they are polished
  kShape,    // the places that the curve's shape suggests; its search is a token
  kDefault,  // the fit with its default settings, as it is
};

template <>
struct EnumTable<ContenderKind> {
  static constexpr EnumText<ContenderKind> kRows[] = {{ContenderKind::kSearch, "search"},
                                                      {ContenderKind::kShape, "shape"},
                                                      {ContenderKind::kDefault, "default"}};
};

// One competitor: how it searches. Seed and number of the run are set by the comparison, so that in
// run r all of ours start from the same first birds.
struct Contender {
  std::string name;       // as tables show it, no two the same: "mlo", "pagmo:de1220", "mlo@420"
  std::string algorithm;  // without its setting, "mlo"; empty: the name
  SearchOptions search;
  SearchFunction searcher;  // empty: Search()
  ContenderKind kind = ContenderKind::kSearch;
  StartsFrom starts = StartsFrom::kAll;  // see FitOptions
  Birds birds = Birds::kAll;             // the same; kHard is for curves, not for families
  std::int64_t budget = 0;  // of evaluations that it stands for in a study of budgets; 0: none
};

// A curve, or a set of curves, that searches are compared on.
struct CompareCurve {
  IvCurve curve;
  BoundsSpec bounds;
  // Subjects with the same name here are devices of one problem, and summed up as one; see pool.h.
  std::string problem;
  // What is its own instead of the comparison's, empty: as there. Effects are fitted to the solved
  // current, whatever is said here.
  std::optional<Model> model;
  std::optional<Objective> objective;
  std::vector<EffectUse> with;
  // A family instead of a curve, with its own law, model, effects and bounds.
  std::optional<CurveSet> set;
  FamilyOptions family;
};

struct CompareOptions {
  std::vector<Model> models = {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode};
  Objective objective = Objective::kMeasuredCurrent;  // of search, polish and every figure
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<EffectUse> with;  // of every model; see FitOptions
  bool force_effects = false;
  std::uint64_t seed = 0;
  int runs = 50;             // of each contender on each problem: runs 0 .. runs - 1 of the seed
  double target_gap = 1e-3;  // relative distance from the reference that counts as "reached"
  bool polish = true;
  bool plain_polish = false;  // see FitOptions
  bool rankings = true;       // rank tests of the contenders against each other
  // Random points that are polished to their end, beside long searches, to find the best known
  // optimum of a problem that no certificate is at hand for; 0: the runs alone. See best_known.h.
  int multistart = 0;
  int threads = 0;  // 0: all cores; never changes a result but the seconds
  const Kernel* kernel = nullptr;
  // A file that every finished run is written to, and that a study is taken up from; empty: none.
  // Taken up, it ends with the bits of one that was never interrupted. `runs`, `target_gap`,
  // `rankings` and `threads` may be others than before.
  std::string journal;
  std::string journal_section = "comparison";  // of a file that several studies share
};

// RMSE in ampere, all of the objective compared. NaN: not asked for. Where effects have several
// forms (law/forms.h) it is times FitReport::form_price, so that the best form has the lowest.
struct RunRecord {
  int run = 0;  // number of the run, which with the seed names its random stream
  double searched_A = kUnknown;
  double plain_polished_A = kUnknown;  // one bounded solve from the best bird
  double own_polished_A = kUnknown;    // the best bird's own polish
  double polished_A = kUnknown;        // the hybrid: best of all starts
  std::int64_t evaluations = 0;
  std::int64_t curve_evaluations = 0;  // that those cost; see FitReport
  // Of the search alone, counted in whole iterations; -1: never reached.
  std::int64_t evaluations_to_target = -1;
  double search_seconds = 0;
  double polish_seconds = 0;        // from all starts
  double plain_seconds = kUnknown;  // of the best bird's plain solve
  double own_seconds = kUnknown;    // of the best bird's own polish
  // Of problems that are pooled: where the best bird's own polish and the hybrid ended, in the
  // order of Reference::parameters. Empty: not kept.
  std::vector<double> own_parameters;
  std::vector<double> parameters;
};

struct Spread {
  double min = kUnknown;
  double mean = kUnknown;
  double median = kUnknown;
  double max = kUnknown;
  double std = kUnknown;  // n - 1 in the denominator; 0 for one run
  int within_1e9 = 0;     // runs no more than that far (relative) above the reference
  int within_1e6 = 0;
};

// A point of the median course of the searches.
struct MedianPoint {
  std::int64_t evaluations = 0;
  double best_A = kUnknown;  // median over the runs of the best so far
};

struct ContenderResult {
  std::string name;
  std::string algorithm;
  SearchOptions search;
  ContenderKind kind = ContenderKind::kSearch;
  Birds birds = Birds::kAll;
  std::int64_t budget = 0;
  std::vector<RunRecord> runs;
  Spread searched;
  Spread plain_polished;
  Spread own_polished;
  Spread polished;
  int target_hits = 0;                     // runs whose search reached the target
  double expected_evaluations = kUnknown;  // to the target: evaluations of all runs, each up to its
                                           // hit, by hits (Hansen et al. 2021, COCO); NaN: no hit
  double evaluations = 0;                  // mean of a run, as are the seconds
  double curve_evaluations = 0;            // and this
  double search_seconds = 0;
  double polish_seconds = 0;
  std::vector<MedianPoint> trace;  // about 60 points, evenly spaced in the logarithm
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

// Ranks of the contenders with the runs as blocks. Empty for fewer than two contenders or two runs.
struct Ranking {
  Friedman friedman;
  std::vector<RankPair> pairs;  // every pair of contenders
  struct SignedRank {
    int first = 0;
    int second = 0;
    Wilcoxon test;
    double p_holm = 1;  // over all pairs
  };
  std::vector<SignedRank> signed_ranks;  // every pair
};

// One curve, or set of curves, with one model.
struct ProblemResult {
  std::string curve_name;
  Model model = Model::kSingleDiode;
  std::string bounds_name;
  // What it is pooled under (pool.h): the subject's own, else, of a curve with effects, the
  // curve's name. Empty: a plain problem on its own.
  std::string problem;
  Objective objective = Objective::kMeasuredCurrent;
  std::vector<EffectUse> with;
  bool family = false;
  std::vector<std::string> parameters;  // keys, in the order of Reference::parameters
  int first_effect = -1;                // where those of the effects begin; -1: none
  Reference reference;
  std::vector<ContenderResult> contenders;
  // Of the runs that every contender has done.
  Ranking searched;
  Ranking polished;  // the hybrid's figures; those within 1e-9 of each other count as equal
  // False where runs, or the proof of the reference, were cut short: only what was done is there,
  // and contenders without a single run are left out.
  bool complete = true;
};

struct Comparison {
  std::string version;
  CompareOptions options;
  std::vector<ProblemResult> problems;  // curves in the order given, each with all models; those
                                        // without a single run are left out
  std::vector<std::string> doubts;      // of the readings, before any run; see CheckReadings
  double seconds = 0;
  bool interrupted = false;          // some problem is not complete
  std::vector<std::string> remarks;  // on the journal, in plain sentences
};

// A curve on its own.
CompareCurve MakeSubject(IvCurve curve, BoundsSpec bounds);

// One of the made devices of a problem.
CompareCurve SubjectOf(LandscapeCase made);

// Runs every contender `runs` times on every curve with every model. Everything is checked before
// the first run. Run r of all contenders comes before run r + 1 of any. The observer hears of stage
// "compare" at the beginning, after every run (iteration: runs done of those planned) and now and
// then in between. Errors: an unusable curve, options outside their ranges, bounds that do not fit
// a model, no or two equal contender names, a journal of another study.
Expected<Comparison> Compare(const std::vector<CompareCurve>& curves,
                             const std::vector<Contender>& contenders,
                             const CompareOptions& options = {}, const Observer& observer = {});

// Contenders for the common studies. `search` gives population, iterations and the settings of the
// algorithms.
std::vector<Contender> PlainContenders(const std::vector<Algorithm>& algorithms,
                                       const SearchOptions& search);
// MLO at every Pm and gamma, Pm the outer loop. Names read "Pm=0.5 gamma=0.25".
std::vector<Contender> SensitivityContenders(const std::vector<double>& memory_rates,
                                             const std::vector<double>& distance_coefficients,
                                             const SearchOptions& search);
// "shape" and "default", by their kind; what they search with is set by themselves.
Contender OwnContender(ContenderKind kind);
// Every algorithm with every budget of evaluations, the algorithm the outer loop. The population is
// about the root of the budget, 4 to 100. Names read "mlo@420".
std::vector<Contender> BudgetContenders(const std::vector<Algorithm>& algorithms,
                                        const std::vector<std::int64_t>& budgets,
                                        const SearchOptions& search = {});
// `search` with population, iterations and the limit of evaluations that such a budget gets.
SearchOptions BudgetSearch(std::int64_t budget, SearchOptions search = {});

}  // namespace lyrefit
