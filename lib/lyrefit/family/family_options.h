// Experimental: may change in a minor version (data/stable).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// Weights of the curves of a set in the sum of squares. If every curve states a standard deviation
// of each current, those standard deviations set the weights instead.
enum class FamilyWeights {
  kAuto,   // kEqual or kIsc, selected by the residuals of a joint fit
  kEqual,  // all points equal, in ampere
  kIsc,    // relative to the short-circuit current of each curve
};

template <>
struct EnumTable<FamilyWeights> {
  static constexpr EnumText<FamilyWeights> kRows[] = {{FamilyWeights::kAuto, "auto"},
                                                      {FamilyWeights::kEqual, "equal"},
                                                      {FamilyWeights::kIsc, "isc"}};
};

// What the residuals of a joint fit compare.
enum class FamilyResiduals {
  kAuto,       // kKeyPoints if every curve states key points in place of a sweep, else kCurrents
  kCurrents,   // the current of every reading
  kKeyPoints,  // Isc, Voc, Vmp (dP/dV = 0 there) and Pmp of every curve
};

template <>
struct EnumTable<FamilyResiduals> {
  static constexpr EnumText<FamilyResiduals> kRows[] = {
      {FamilyResiduals::kAuto, "auto"},
      {FamilyResiduals::kCurrents, "currents"},
      {FamilyResiduals::kKeyPoints, "key-points"}};
};

// Relative standard deviations of measured key points, from condition to condition: what all
// conditions share (the lamp, the temperature sensor) does not count. Only their ratios weigh; the
// residuals give the sizes. Defaults: typical of indoor matrices by IEC 61853-1.
struct KeyPointErrors {
  double short_circuit_current = 0.004;  // of Isc
  double open_circuit_voltage = 0.003;   // of Voc
  double max_power_voltage = 0.006;      // of Vmp; the largest: power is flat there
  double max_power = 0.003;              // of Pmp
  // Errors common to all conditions of one set temperature, and relative ones common to one level of
  // light. They widen intervals and do not weigh. NaN: found from the residuals.
  double temperature_K = kUnknown;
  double irradiance = kUnknown;
};

// Reads "isc=0.4%,voc=0.3%,vmp=0.6%,pmp=0.3%,temperature=0.3K,light=0.3%"; what is not named keeps
// its value. Errors: an unknown name, a part that is not above 0 and at most 50 %; a shared error that
// is not from 0 to 20 K or 50 %.
Expected<void> ReadKeyPointErrors(const std::string& text, KeyPointErrors* errors);
// As ReadKeyPointErrors reads it; shared errors only where stated.
std::string KeyPointErrorsText(const KeyPointErrors& errors);

// Options of FitFamily: the law, the known accuracy of the sensors, and the tests of the result.
struct FamilyOptions {
  TranslationLaw law = TranslationLaw::kDeSoto;
  Model model = Model::kSingleDiode;  // sd or dd
  std::optional<ShuntLaw> shunt;      // unset: inverse for desoto, exponential for pvsyst
  bool recombination = false;         // pvsyst only
  Objective objective = Objective::kSolvedCurrent;
  ConstantSet constants = ConstantSet::kCodata;
  // Fixed parameters by symbol or name: "EgRef" -> 1.121. Fixed by default: dEgdT -0.0002677,
  // PVsyst's EgRef 1.121, R_sh_exp 5.5, NsVbi 0.9 V a cell, n2 = 2. Also fixed by default are
  // alpha_sc, EgRef and mu_gamma if the temperature hardly varies over the set.
  std::map<std::string, double> fixed;
  std::vector<std::string> freed;  // parameters fixed by default that are fitted
  BoundsSpec::Table bounds;        // ranges of single shared parameters
  // Effects added to the diodes, shared by all curves, as in FitOptions. They require De Soto's law
  // and the solved-current objective. Dark curves are then fitted as well.
  std::vector<EffectUse> with;
  bool force_effects = false;  // also effects that these data cannot show
  ErrorSpec errors;            // of curves fitted individually, as in FitOptions
  FamilyResiduals residuals = FamilyResiduals::kAuto;  // what is compared
  KeyPointErrors key_point_errors;                     // weights of key points
  FamilyWeights weights = FamilyWeights::kAuto;        // weights of currents
  SearchOptions search = FamilySearch();
  SearchFunction searcher;  // a search to use instead of Search(); empty: Search()
  // Starts of the joint fit. kShape omits the search's candidates, kSearch uses only these.
  StartsFrom starts = StartsFrom::kAll;
  bool plain_polish = false;  // also polish the best candidate alone, as in FitOptions
  int search_curves = 6;      // number of well-spread curves in the search
  int fit_curves = 0;  // number of well-spread curves in the joint fit; the others are held out and
                       // tested; 0: all
  // One common error of each sensor as a shared unknown: true value = reading + offset.
  bool irradiance_offset = false;
  bool temperature_offset = false;
  // Stated accuracy of the sensors as one standard deviation. Every curve gets its own offset with
  // that prior. 0: readings are taken as exact.
  double irradiance_accuracy = 0;  // relative, 0.02 = 2 %
  double temperature_accuracy_K = 0;
  bool random_baseline = true;
  bool intervals = true;
  bool individual_fits = true;  // also fit every curve individually: the floor of the RMSE
  int folds = 5;                // folds of cross-validation over curves; 0: none. Not used with
                                // fit_curves.
  std::vector<std::string> leave_out;  // ids of curves to leave out
  // Published or other parameters to test beside the joint fit. Error if their number of cells
  // differs from that of the set.
  std::vector<NamedParameters> against;
  int threads = 0;  // 0: all cores; results do not depend on it

  // Default search options of a family fit.
  static SearchOptions FamilySearch() {
    SearchOptions search;
    search.population = 30;
    search.iterations = 60;
    return search;
  }
};

// Reads a percentage, "2" or "2%". Error: not a percentage from 0 to 50.
Expected<void> ReadIrradianceAccuracy(const std::string& text, FamilyOptions* options,
                                      const TextReaders&);
// Reads one id or several, "17,18".
Expected<void> ReadLeaveOut(const std::string& text, FamilyOptions* options, const TextReaders&);

inline constexpr OptionRow<FamilyOptions> kFamilyOptionTable[] = {
    OptionRow<FamilyOptions>("Family"),
    {"family", "NAME", "how parameters follow irradiance and temperature",
     EnumOption<&FamilyOptions::law>(), OptionTrait::kNoFlag},
    {"model", "NAME", "number of diodes", EnumOption<&FamilyOptions::model>(),
     OptionTrait::kNoFlag},
    {"shunt", "NAME", "how the shunt follows irradiance", EnumOption<&FamilyOptions::shunt>(),
     OptionTrait::kNone, " inverse for desoto, exponential for pvsyst"},
    {"recombination", "", "pvsyst's recombination loss in the i-layer of thin films",
     &FamilyOptions::recombination},
    {"objective", "NAME", "which residual is squared", EnumOption<&FamilyOptions::objective>(),
     OptionTrait::kNoFlag},
    {"constants", "NAME", "values of k and q", EnumOption<&FamilyOptions::constants>(),
     OptionTrait::kNoFlag},
    {"fix", "P=VALUE", "holds a parameter, EgRef=1.121; once for each",
     AssignmentsOption<&FamilyOptions::fixed>(), OptionTrait::kNoFlag},
    {"free", "P", "fit a parameter that else is active, EgRef; once for each",
     &FamilyOptions::freed},
    {"with", kEffectsUnit, kEffectsDoc, EffectsOption<&FamilyOptions::with>(),
     OptionTrait::kNoFlag},
    {"force", "", "also effects that data of this kind cannot show", &FamilyOptions::force_effects,
     OptionTrait::kNoFlag},
    {"bound", "P=LOWER:UPPER", "range of one shared parameter, Rs=0:0.5; once for each",
     RangesOption<&FamilyOptions::bounds>(), OptionTrait::kNoFlag},
    {"residuals", "NAME",
     "what is compared: every current, or the key points of every curve (auto: if only these are "
     "stated)",
     EnumOption<&FamilyOptions::residuals>()},
    {"key-point-errors", "LIST",
     "how well key points are measured against each other, isc=0.4%,voc=0.3%,vmp=0.6%,pmp=0.3%, "
     "and "
     "what conditions of one set temperature or of one light share, temperature=0.3K,light=0.3% "
     "(by "
     "default found from the residuals)",
     OptionText<FamilyOptions>{
         [](const std::string& text, FamilyOptions* options, const TextReaders&) {
           return ReadKeyPointErrors(text, &options->key_point_errors);
         },
         [](const FamilyOptions& options) -> std::vector<std::string> {
           return {KeyPointErrorsText(options.key_point_errors)};
         }}},
    {"weights", "NAME",
     "how curves count: every point alike, relative to Isc, or as the residuals say",
     EnumOption<&FamilyOptions::weights>()},
    {"algorithm", "NAME", "how to search",
     EnumOption<&FamilyOptions::search, &SearchOptions::algorithm>(), OptionTrait::kNoFlag},
    {"search-options", "", "the search's own options",
     OptionNest<FamilyOptions>{[](const FamilyOptions& options, const FamilyOptions& defaults,
                                  std::vector<OptionEcho>* echoes) {
       AppendNonDefaults(options.search, defaults.search, kSearchOptionTable, echoes);
     }}},
    {"search", "", "a search of one's own",
     OptionText<FamilyOptions>{nullptr,
                               [](const FamilyOptions& options) -> std::vector<std::string> {
                                 return {options.searcher ? "of its own" : ""};
                               }},
     OptionTrait::kNoFlag},
    {"starts", "NAME", "where the joint fit begins", EnumOption<&FamilyOptions::starts>(),
     OptionTrait::kNoFlag},
    {"search-curves", "N", "well-spread curves that the search sees", &FamilyOptions::search_curves,
     2, 1e6, OptionTrait::kQuiet},
    {"fit-curves", "N", "well-spread curves that are fitted, the others are tested; 0: all",
     &FamilyOptions::fit_curves, 0, 1e6, OptionTrait::kQuiet},
    {"irradiance-offset", "", "fit one error of the irradiance sensor, common to all curves",
     &FamilyOptions::irradiance_offset},
    {"temperature-offset", "", "fit one error of the temperature sensor, common to all curves",
     &FamilyOptions::temperature_offset},
    {"irradiance-accuracy", "PERCENT", "standard deviation of each irradiance, in percent: 2 or 2%",
     OptionText<FamilyOptions>{ReadIrradianceAccuracy,
                               [](const FamilyOptions& options) -> std::vector<std::string> {
                                 return {NumberText(100 * options.irradiance_accuracy)};
                               }},
     OptionTrait::kNoDefault},
    {"temperature-accuracy", "K", "standard deviation of each temperature, in kelvin",
     &FamilyOptions::temperature_accuracy_K, 0, 50, OptionTrait::kQuiet | OptionTrait::kNoDefault},
    {"random-baseline", "", "the best of as many random points beside the search's figure",
     &FamilyOptions::random_baseline, OptionTrait::kNoFlag},
    {"intervals", "", "95 % intervals", &FamilyOptions::intervals, OptionTrait::kNoFlag},
    {"individual-fits", "", "do not also fit every curve on its own, the floor of the joint fit",
     &FamilyOptions::individual_fits},
    {"folds", "N", "whole curves left out in turn, to test the answer; 0: none",
     &FamilyOptions::folds, 0, 1e6, OptionTrait::kQuiet},
    {"leave-out", "ID[,ID]", "curves that are not fitted",
     OptionText<FamilyOptions>{ReadLeaveOut,
                               [](const FamilyOptions& options) { return options.leave_out; },
                               nullptr, true}},
    {"against", "FILE", "parameters from elsewhere, tested on the same curves",
     OptionText<FamilyOptions>{nullptr,
                               [](const FamilyOptions& options) {
                                 std::vector<std::string> names;
                                 for (const NamedParameters& other : options.against) {
                                   names.push_back(other.name);
                                 }
                                 return names;
                               },
                               nullptr, true},
     OptionTrait::kNoFlag},
    {"threads", "N", "0: all cores; never changes a result", &FamilyOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoFlag | OptionTrait::kNoEcho},
};

}  // namespace lyrefit
