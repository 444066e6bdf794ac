// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"
#include "lyrefit/base/setting_text.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/search/search_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Light of the top and the bottom junction in one curve, as shares of their light under the
// reference spectrum. NaN: unknown, so that the photocurrent is an unknown of that curve.
struct StatedLight {
  double top = kUnknown;     // junction 1
  double bottom = kUnknown;  // junction 2
};

// Parses "red=1:0.9", or "red=1:?" with an unknown light, into the id of a curve and its light.
Expected<std::pair<std::string, StatedLight>> ReadStatedLight(const std::string& text);
// Formats a stated light as ReadStatedLight reads it.
std::string StatedLightText(const std::string& curve, const StatedLight& light);

// Options of FitTwoJunctions().
struct TwoJunctionOptions {
  // Stated lights, by the id of the curve. They replace those beside the data (DeviceNotes).
  std::map<std::string, StatedLight> lights;
  // Standard deviation of each stated light, as a part of it; 0: exact. NaN: exact, unless the curves
  // miss each other by more than noise; then found from them. Lights of 1:1 are exact: they define
  // the reference.
  double light_accuracy = kUnknown;
  std::map<std::string, std::pair<double, double>> bounds;  // ranges by symbol or name
  std::map<std::string, double> fixed;                      // values by symbol or name
  ConstantSet constants = ConstantSet::kCodata;
  SearchOptions search;
  Intervals intervals = Intervals::kProfile;
  int threads = 0;  // 0: all cores; never changes a result
};

// Reads a percentage, "2" or "2%". Error: not a percentage from 0 to 50.
Expected<void> ReadLightAccuracy(const std::string& text, TwoJunctionOptions* options,
                                 const TextReaders&);

inline constexpr OptionRow<TwoJunctionOptions> kTwoJunctionOptionTable[] = {
    OptionRow<TwoJunctionOptions>("Two junctions"),
    {"light", "CURVE=TOP:BOTTOM",
     "light of both junctions in a curve as shares of the reference spectrum, red=1:0.9; ? where "
     "it is unknown; once for each curve",
     MapOption<ReadStatedLight, StatedLightText, &TwoJunctionOptions::lights>(),
     OptionTrait::kExperimental},
    {"light-accuracy", "PERCENT",
     "standard deviation of each stated light but 1:1, 2 or 2%; 0: exact (by default found from "
     "the "
     "curves where they disagree)",
     OptionText<TwoJunctionOptions>{
         ReadLightAccuracy,
         [](const TwoJunctionOptions& options) -> std::vector<std::string> {
           return {std::isnan(options.light_accuracy) ? std::string()
                                                      : NumberText(100 * options.light_accuracy)};
         }},
     OptionTrait::kNoDefault | OptionTrait::kExperimental},
    {"bound", "P=LOWER:UPPER", "range of one parameter, Rs=0:0.5; once for each",
     RangesOption<&TwoJunctionOptions::bounds>(), OptionTrait::kNoFlag},
    {"fix", "P=VALUE", "holds a parameter, n2=2; once for each",
     AssignmentsOption<&TwoJunctionOptions::fixed>(), OptionTrait::kNoFlag},
    {"constants", "NAME", "values of k and q", EnumOption<&TwoJunctionOptions::constants>(),
     OptionTrait::kNoFlag},
    {"search", "", "the search's own options",
     OptionNest<TwoJunctionOptions>{[](const TwoJunctionOptions& options,
                                       const TwoJunctionOptions& defaults,
                                       std::vector<OptionEcho>* echoes) {
       AppendNonDefaults(options.search, defaults.search, kSearchOptionTable, echoes);
     }}},
    {"intervals", "NAME", "95 % intervals", EnumOption<&TwoJunctionOptions::intervals>(),
     OptionTrait::kNoFlag},
    {"threads", "N", "0: all cores; never changes a result", &TwoJunctionOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoEcho | OptionTrait::kNoFlag},
};

}  // namespace lyrefit
