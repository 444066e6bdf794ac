// Experimental: may change in a minor version (data/stable).
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
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// The stage of the hybrid fit that an algorithm evaluates.
enum class AlgorithmKind {
  kSearch,   // a search; its candidates are reported at every polish level
  kShape,    // starts derived from the curve's shape; the search is minimal
  kDefault,  // the fit with its default settings
};

template <>
struct EnumTable<AlgorithmKind> {
  static constexpr EnumText<AlgorithmKind> kRows[] = {{AlgorithmKind::kSearch, "search"},
                                                      {AlgorithmKind::kShape, "shape"},
                                                      {AlgorithmKind::kDefault, "default"}};
};

// One algorithm of a comparison and its search settings. The comparison sets the seed and the
// number of the run. In run r all algorithms of lyrefit therefore start from the same first
// candidates.
struct ComparedAlgorithm {
  std::string name;         // unique, as tables show it: "mlo", "pagmo:de1220", "mlo@420"
  std::string algorithm;    // name without settings, "mlo"; empty: same as `name`
  SearchOptions search;     // budget and settings
  SearchFunction searcher;  // empty: Search() is used
  // Tells versions of a searcher apart: a journal of another one is refused. May be empty.
  std::string searcher_version = {};
  AlgorithmKind kind = AlgorithmKind::kSearch;
  StartsFrom starts = StartsFrom::kAll;  // see FitOptions
  std::int64_t budget = 0;  // nominal budget of evaluations in a study of budgets; 0: none
};

// A curve, or a set of curves, on which searches are compared.
struct CompareCurve {
  IvCurve curve;
  BoundsSpec bounds;
  // Inputs with the same `problem` are devices of one problem and are summarised together; see
  // problem_summary.h.
  std::string problem;
  // Settings that override those of the comparison; empty: no override. With effects the objective
  // is always the solved current.
  std::optional<Model> model;
  std::optional<Objective> objective;
  std::vector<EffectUse> with;
  // A family instead of a single curve, with its own law, model, effects and bounds.
  std::optional<CurveSet> set;
  FamilyOptions family;
};

// Number of runs, models and outputs of a comparison.
struct CompareOptions {
  std::vector<Model> models = {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode};
  Objective objective = Objective::kMeasuredCurrent;  // of search, polish and every reported RMSE
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<EffectUse> with;  // effects of every model; see FitOptions
  bool force_effects = false;
  std::uint64_t seed = 0;
  int runs = 50;             // of each algorithm on each problem: runs 0 .. runs - 1 of the seed
  double target_gap = 1e-3;  // relative distance from the reference that counts as "reached"
  bool polish = true;
  bool plain_polish = false;  // see FitOptions
  bool rankings = true;       // compute rank tests between the algorithms
  // Number of random points that are polished, beside long searches, to find the best known optimum
  // of a problem without a certificate. 0: only the compared runs are used. See reference.h.
  int multistart = 0;
  int threads = 0;  // 0: all cores; affects only the measured seconds
  const Kernel* kernel = nullptr;
  // File to which every finished run is appended and from which a study is resumed; empty: none. A
  // resumed study ends with the same bits as an uninterrupted one. `runs`, `target_gap`, `rankings`
  // and `threads` may differ from the first run.
  std::string journal;
  // Section of a journal file that several studies share.
  std::string journal_section = "comparison";
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
     "certificate is at hand for (default 100 with effects, else 0)",
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
