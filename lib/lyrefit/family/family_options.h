#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/family/read_pvlib.h"
#include "lyrefit/fit/bounds.h"
#include "lyrefit/fit/error_spec.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/law/device.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/translation.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// How the curves of a set count in the sum of squares. Where every curve states a standard
// deviation of each current, that counts instead.
enum class FamilyWeights {
  kEqual,  // every point alike, in ampere
  kIsc,    // relative to the largest current of its own curve
};

template <>
struct EnumTable<FamilyWeights> {
  static constexpr EnumText<FamilyWeights> kRows[] = {{FamilyWeights::kEqual, "equal"},
                                                      {FamilyWeights::kIsc, "isc"}};
};

struct FamilyOptions {
  TranslationLaw law = TranslationLaw::kDeSoto;
  Model model = Model::kSingleDiode;  // sd or dd
  std::optional<ShuntLaw> shunt;      // unset: inverse for desoto, exponential for pvsyst
  bool recombination = false;         // pvsyst only
  Objective objective = Objective::kSolvedCurrent;
  ConstantSet constants = ConstantSet::kCodata;
  // By symbol or name: "EgRef" -> 1.121. Held where nothing is said: dEgdT -0.0002677, PVsyst's
  // EgRef 1.121, R_sh_exp 5.5, NsVbi 0.9 V a cell, n2 = 2; and alpha_sc, EgRef and mu_gamma
  // where the temperature hardly varies over the set.
  std::map<std::string, double> fixed;
  std::vector<std::string> freed;  // parameters of that list to be fitted after all
  BoundsSpec::Table bounds;        // of single shared parameters
  // Effects beside the diodes, shared by all curves, as in FitOptions; with De Soto's law alone,
  // and fitted to the solved current. Dark curves are then fitted as well.
  std::vector<EffectUse> with;
  bool force_effects = false;  // also those that data of this kind cannot show
  ErrorSpec errors;            // of curves fitted one by one, as in FitOptions
  FamilyWeights weights = FamilyWeights::kEqual;
  SearchOptions search = FamilySearch();
  SearchFunction searcher;  // a search of your own in the place of Search(); empty: Search()
  // Where the joint fit begins: kShape leaves out the search's birds, kSearch all but these.
  StartsFrom starts = StartsFrom::kAll;
  bool plain_polish = false;  // what becomes of the best bird by itself, as in FitOptions
  int search_curves = 6;      // the search sees so many well-spread curves
  int fit_curves = 0;  // the joint fit sees so many well-spread curves, the others are held out
                       // and tested; 0: all
  // One common error of each sensor, as shared unknowns: true = reading + offset.
  bool irradiance_offset = false;
  bool temperature_offset = false;
  // Stated accuracy of the sensors, one standard deviation: every curve gets an offset of its own
  // with that prior. 0: the readings are taken as they are.
  double irradiance_accuracy = 0;  // relative, 0.02 = 2 %
  double temperature_accuracy_K = 0;
  bool random_baseline = true;
  bool intervals = true;
  bool free_fits = true;  // also fit every curve on its own: the floor
  int folds = 5;          // whole curves left out in turn; 0: none. Not used with fit_curves.
  std::vector<std::string> leave_out;  // ids
  // Parameters from elsewhere that are tested beside the joint fit. Error where they are of another
  // number of cells than the set.
  std::vector<NamedParameters> against;
  int threads = 0;  // 0: all cores; never changes a result

  static SearchOptions FamilySearch() {
    SearchOptions search;
    search.population = 30;
    search.iterations = 60;
    return search;
  }
};

}  // namespace lyrefit
