#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/fit/bounds.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/law/device.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// What of the hybrid a compared is about.
enum class AlgorithmKind {
  kSearch,   // a search; what becomes of its candidates is looked at by how far they are polished
  kShape,    // the places that the curve's shape suggests; its search is a token
  kDefault,  // the fit with its default settings, as it is
};

template <>
struct EnumTable<AlgorithmKind> {
  static constexpr EnumText<AlgorithmKind> kRows[] = {{AlgorithmKind::kSearch, "search"},
                                                      {AlgorithmKind::kShape, "shape"},
                                                      {AlgorithmKind::kDefault, "default"}};
};

// One competitor: how it searches. Seed and number of the run are set by the comparison, so that in
// run r all of ours start from the same first candidates.
struct ComparedAlgorithm {
  std::string name;         // as tables show it, no two the same: "mlo", "pagmo:de1220", "mlo@420"
  std::string algorithm;    // without its setting, "mlo"; empty: the name
  SearchOptions search;     // budget and settings
  SearchFunction searcher;  // empty: Search()
  AlgorithmKind kind = AlgorithmKind::kSearch;
  StartsFrom starts = StartsFrom::kAll;  // see FitOptions
  SearchVariables candidates = SearchVariables::kAll;             // the same; kHard is for curves, not for families
  std::int64_t budget = 0;  // of evaluations that it stands for in a study of budgets; 0: none
};

// A curve, or a set of curves, that searches are compared on.
struct CompareCurve {
  IvCurve curve;
  BoundsSpec bounds;
  // Subjects with the same name here are devices of one problem, and summed up as one; see problem_summary.h.
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

// Who is compared, how often, and what is reported.
struct CompareOptions {
  std::vector<Model> models = {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode};
  Objective objective = Objective::kMeasuredCurrent;  // of search, polish and every figure
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<EffectUse> with;  // of every model; see FitOptions
  bool force_effects = false;
  std::uint64_t seed = 0;
  int runs = 50;             // of each compared on each problem: runs 0 .. runs - 1 of the seed
  double target_gap = 1e-3;  // relative distance from the reference that counts as "reached"
  bool polish = true;
  bool plain_polish = false;  // see FitOptions
  bool rankings = true;       // rank tests of the algorithms against each other
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

inline constexpr OptionRow<CompareOptions> kCompareOptionTable[] = {
    OptionRow<CompareOptions>("Model"),
    {"models", "LIST", "list of sd, dd, td", EnumListOption<&CompareOptions::models>()},
    {"objective", "NAME", "which residual is squared", EnumOption<&CompareOptions::objective>()},
    {"constants", "NAME", "values of k and q", EnumOption<&CompareOptions::constants>()},
    {"with", kEffectsUnit, kEffectsDoc, EffectsOption<&CompareOptions::with>()},
    {"force", "", "also effects that data of this kind cannot show", &CompareOptions::force_effects,
     OptionTrait::kNoFlag},
    OptionRow<CompareOptions>("Runs"),
    {"runs", "NUMBER", "runs of each algorithm on each problem", &CompareOptions::runs,
     OptionTrait::kUnchecked},
    {"seed", "NUMBER", "seed of all runs; run r has its own stream", &CompareOptions::seed,
     OptionTrait::kUnchecked},
    {"threads", "N", "0: all cores; never changes a result but the seconds",
     &CompareOptions::threads, 0, kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoEcho},
    {"multistart", "N",
     "random points polished to their end to know the best optimum of a problem that no "
     "certificate is at hand for (default 100 with effects or --landscape, else 0)",
     &CompareOptions::multistart, 0, 1e6,
     OptionTrait::kQuiet | OptionTrait::kNoDefault | OptionTrait::kNoFlag},
    {"target-gap", "NUMBER", "relative distance from the reference that counts as reached",
     &CompareOptions::target_gap, OptionTrait::kUnchecked | OptionTrait::kNoFlag},
    {"rankings", "", "rank tests of the algorithms against each other", &CompareOptions::rankings,
     OptionTrait::kNoFlag},
    OptionRow<CompareOptions>("Polish"),
    {"polish", "", "the search alone", &CompareOptions::polish},
    {"plain-polish", "",
     "also one bounded least-squares solve from the best candidate, and nothing more",
     &CompareOptions::plain_polish},
};

}  // namespace lyrefit
