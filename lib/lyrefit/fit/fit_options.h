#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/fit/bounds.h"
#include "lyrefit/fit/error_spec.h"
#include "lyrefit/law/device.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// How the polish weighs large residuals. The robust ones are fitted by reweighting: r and k are the
// residual and `loss_scale`, both in units of the noise.
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

// Where the polish of a model with effects begins.
enum class StartsFrom {
  kAll,
  kSearch,  // the birds of the search alone
  kShape,   // places that the shape of the curve suggests (plateaus, shoulders), without the search
};

// What a bird of the search stands for.
enum class Birds {
  kAll,   // a complete device
  kHard,  // its hard parameters alone: Rs, the n and the effects; see fit/birds.h
};

template <>
struct EnumTable<Birds> {
  static constexpr EnumText<Birds> kRows[] = {{Birds::kAll, "all"}, {Birds::kHard, "hard"}};
};

enum class Intervals { kNone, kSymmetric, kProfile };

template <>
struct EnumTable<Intervals> {
  static constexpr EnumText<Intervals> kRows[] = {{Intervals::kNone, "none"},
                                                  {Intervals::kSymmetric, "symmetric"},
                                                  {Intervals::kProfile, "profile"}};
};

struct FitOptions {
  Model model = Model::kSingleDiode;
  Objective objective = Objective::kSolvedCurrent;
  ConstantSet constants = ConstantSet::kCodata;
  BoundsSpec bounds;                    // physical ones derived from the curve unless said
  std::map<std::string, double> fixed;  // by symbol or name: "n2" -> 2
  // Effects beside the diodes (FindEffect, or your own), searched, polished and reported like them;
  // see law/extension.h. The objective is then the solved current.
  std::vector<EffectUse> with;
  bool force_effects = false;  // also those that data of this kind cannot show
  SearchOptions search;
  Birds birds = Birds::kAll;
  SearchFunction searcher;  // a search of your own in the place of Search(); empty: Search()
  bool random_baseline =
      true;  // print the best of as many random points beside the search's figure
  bool polish = true;
  bool plain_polish = false;  // also try one bounded least-squares solve from the best bird, and
                              // nothing more, and polish that bird by itself to its end
  StartsFrom starts = StartsFrom::kAll;
  bool floor = false;  // also prove how low the measured-current RMSE can go within the bounds
  // What the polish and the intervals take the errors of the readings for. kWhite: the estimates
  // are those of least squares, and where the residuals ask for it intervals under the error model
  // stand beside theirs. The others need the solved current and squared residuals.
  ErrorSpec errors;
  Loss loss = Loss::kSquared;  // of the polish; the search always ranks birds by squares
  double loss_scale = 3;       // residual in noise units beyond which the robust losses bend
  Intervals intervals =
      Intervals::kProfile;         // kProfile: profile only where symmetric would be false
  int threads = 0;                 // 0: all cores; never changes a result
  const Kernel* kernel = nullptr;  // nullptr: the fastest

  // For a model with effects: a small flock, as the shape of the curve and the basins that its
  // polish comes to say more about where to look.
  static SearchOptions SearchBesideShapes() {
    SearchOptions search;
    search.population = 10;
    search.iterations = 6;
    return search;
  }
};

}  // namespace lyrefit
