#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"
#include "lyrefit/base/setting_text.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/estimate/fit/effect_text.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// Loss function of the polish. The robust losses are fitted by iterative reweighting; r is the
// residual and k is `loss_scale`, both in units of the noise.
enum class Loss {
  kSquared,
  kHuber,   // weight min(1, k / |r|)
  kCauchy,  // weight 1 / (1 + (r / k)^2)
};

template <>
struct EnumTable<Loss> {
  static constexpr EnumText<Loss> kRows[] = {
      {Loss::kSquared, "squared"}, {Loss::kHuber, "huber"}, {Loss::kCauchy, "cauchy"}};
};

// Starts of the polish of a model with effects.
enum class StartsFrom {
  kAll,
  kSearch,  // candidates of the search only
  kShape,   // starts from plateaus and shoulders of the curve, without the search
};

template <>
struct EnumTable<StartsFrom> {
  static constexpr EnumText<StartsFrom> kRows[] = {
      {StartsFrom::kAll, "all"}, {StartsFrom::kSearch, "search"}, {StartsFrom::kShape, "shape"}};
};

enum class Intervals { kNone, kSymmetric, kProfile };  // Intervals of a fit.

template <>
struct EnumTable<Intervals> {
  static constexpr EnumText<Intervals> kRows[] = {{Intervals::kNone, "none"},
                                                  {Intervals::kSymmetric, "symmetric"},
                                                  {Intervals::kProfile, "profile"}};
};

// Options of a fit of one curve. The defaults suit a single-diode fit.
struct FitOptions {
  Model model = Model::kSingleDiode;
  Objective objective = Objective::kSolvedCurrent;
  ConstantSet constants = ConstantSet::kCodata;
  BoundsSpec bounds;                    // default: physical bounds derived from the curve
  std::map<std::string, double> fixed;  // symbol or name -> value: "n2" -> 2
  // Effects in addition to the diodes (FindEffect, or effects of your own). They are searched,
  // polished and reported like the diode parameters; see model/device_effects.h. The objective must
  // then be the solved current. Experimental, as its type is.
  std::vector<EffectUse> with;
  bool force_effects = false;  // also effects that the data cannot show
  SearchOptions search;
  SearchFunction searcher;  // replaces Search(); empty: Search()
  bool random_baseline =
      true;  // also evaluate as many random points as the search did and report the best
  bool polish = true;
  bool plain_polish = false;  // also run one bounded least-squares solve from the best candidate,
                              // and a full polish of that candidate alone
  StartsFrom starts = StartsFrom::kAll;
  // WithFloor() (certify/floor.h) also proves a lower bound of the RMSE within the bounds.
  bool floor = false;
  // Error model of the readings for polish and intervals. With kWhite the estimates are those of
  // least squares. If the residuals show shared errors, the report has a second set of intervals
  // under the error model. The other kinds need the solved current and squared residuals.
  ErrorSpec errors;
  // Whether kWhite also looks for an error model in the residuals and computes intervals under it.
  // This takes a sixth of the time of a fit.
  bool find_errors = true;
  Loss loss = Loss::kSquared;                 // of the polish; the search always minimises squares
  double loss_scale = 3;                      // k of the robust losses, in noise units
  Intervals intervals = Intervals::kProfile;  // kProfile: only where a symmetric one is invalid
  int threads = 0;                            // 0: all cores; never changes a result
  const Kernel* kernel = nullptr;             // nullptr: the fastest; experimental

  // Search options for a model with effects. The population is small, because the shape of the
  // curve and the local optima of the polish give better starts.
  static SearchOptions SearchBesideShapes() {
    SearchOptions search;
    search.population = 10;
    search.iterations = 6;
    return search;
  }
};

inline constexpr OptionRow<FitOptions> kFitOptionTable[] = {
    OptionRow<FitOptions>("Model"),
    {"model", "NAME", "number of diodes", EnumOption<&FitOptions::model>(), OptionTrait::kNoEcho},
    {"objective", "NAME", "which residual is squared", EnumOption<&FitOptions::objective>()},
    {"constants", "NAME", "values of k and q", EnumOption<&FitOptions::constants>()},
    {"bounds", "NAME|FILE", "the box that is searched",
     OptionText<FitOptions>{nullptr,
                            [](const FitOptions& options) -> std::vector<std::string> {
                              return {options.bounds.name};
                            }},
     OptionTrait::kNoFlag},
    {"bound", "P=LOWER:UPPER", "range of one parameter, Rs=0:0.5; once for each",
     RangesOption<&FitOptions::bounds, &BoundsSpec::overrides>()},
    {"with", kEffectsUnit, kEffectsDoc, EffectsOption<&FitOptions::with>()},
    {"force", "", "also effects that data of this kind cannot show", &FitOptions::force_effects,
     OptionTrait::kNoFlag},
    {"fix", "P=VALUE", "holds a parameter, n2=2; once for each",
     AssignmentsOption<&FitOptions::fixed>()},
    OptionRow<FitOptions>("Search"),
    {"searcher", "", "a search of one's own",
     OptionText<FitOptions>{nullptr,
                            [](const FitOptions& options) -> std::vector<std::string> {
                              return {options.searcher ? "custom" : ""};
                            }},
     OptionTrait::kNoFlag},
    {"plain-polish", "", "also one bounded least-squares solve from the best candidate",
     &FitOptions::plain_polish, OptionTrait::kNoFlag},
    {"algorithm", "NAME", "how to search",
     EnumOption<&FitOptions::search, &SearchOptions::algorithm>()},
    {"search", "", "the search's own options",
     OptionNest<FitOptions>{[](const FitOptions& options, const FitOptions& defaults,
                               std::vector<OptionEcho>* echoes) {
       AppendNonDefaults(options.search,
                         options.with.empty() ? defaults.search : FitOptions::SearchBesideShapes(),
                         kSearchOptionTable, echoes);
     }}},
    {"random-baseline", "", "the best of as many random points beside the search's figure",
     &FitOptions::random_baseline, OptionTrait::kNoFlag},
    {"starts", "NAME", "where the polish of a model with effects begins",
     EnumOption<&FitOptions::starts>(), OptionTrait::kNoFlag | OptionTrait::kNoEcho},
    OptionRow<FitOptions>("Polish"),
    {"polish", "", "answer with the search's best candidate", &FitOptions::polish},
    {"floor", "", "also prove how low the RMSE of the objective can go within the bounds",
     &FitOptions::floor},
    {"noise", "NAME|FILE",
     "errors of the readings that the polish weighs by: white, field (found from the residuals), "
     "or a JSON file with their sizes",
     NoiseOption<&FitOptions::errors>()},
    {"find-errors", "", "also intervals under the errors that the residuals show",
     &FitOptions::find_errors, OptionTrait::kNoFlag},
    {"loss", "NAME", "of the polish", EnumOption<&FitOptions::loss>()},
    {"loss-scale", "NUMBER", "noise units beyond which a robust loss bends",
     &FitOptions::loss_scale, OptionTrait::kUnchecked},
    {"intervals", "NAME", "95 % intervals", EnumOption<&FitOptions::intervals>()},
    {"threads", "N", "0: all cores; never changes a result", &FitOptions::threads, 0, kMostThreads,
     OptionTrait::kQuiet | OptionTrait::kNoEcho},
    {"kernel", "NAME", "instruction set of the heavy loops; never changes a result",
     OptionText<FitOptions>{
         [](const std::string& text, FitOptions* options, const TextReaders&) -> Expected<void> {
           const Expected<const Kernel*> kernel = KernelNamed(text);
           if (!kernel) return tl::unexpected<Error>(kernel.error());
           options->kernel = *kernel;
           return {};
         },
         [](const FitOptions& options) -> std::vector<std::string> {
           return {options.kernel == nullptr ? "" : options.kernel->name};
         },
         KernelNames},
     OptionTrait::kNoEcho, ": the fastest"},
};

}  // namespace lyrefit
