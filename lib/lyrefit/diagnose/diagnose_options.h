// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"
#include "lyrefit/diagnose/priors.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

struct Effect;  // model/effect.h

// Which causes are tried, at which significance, and which additional results are computed.
struct DiagnoseOptions {
  double probability = 0.8;          // smallest probability at which a cause is named
  CausePriors priors;                // how common causes are
  Setup setup = Setup::kUnknown;     // of the measurement; unknown: as the file says
  std::optional<double> age_years;   // of the device in the field; unset: unknown
  Model base = Model::kSingleDiode;  // sd, or dd with n2 = 2
  std::vector<std::string> effects;  // ids to try; empty: all that the data can show
  // Tried in addition to the catalogue. Ids must differ from the catalogue's. The pointers must
  // stay valid during the diagnosis. Each effect needs an id, parameters with finite bounds, a
  // stage and probes.
  std::vector<const Effect*> own_effects;
  std::uint64_t seed = 1;
  // White: independent errors, as in a laboratory. Field: also a rough path along the sweeps, from
  // varying light or a module that departs from the model. Stated: sizes that are used unchanged.
  ErrorSpec noise = {ErrorKind::kField, {}, "field"};
  // A cause is named if the whole interval of its effect lies above one of these floors: fraction
  // of Isc (root mean square over the curve) or of Pmax. Significant causes below both are listed
  // apart.
  double floor_current = 0.0025;
  double floor_power = 0.005;
  int largest_causes = 4;  // largest number of named causes
  bool held_out = true;    // measure the gain on readings that were not fitted
  int folds = 10;
  bool extend = false;  // search and polish the extended model as a FitReport
  int threads = 0;
};

// For low-noise laboratory readings of a device that follows its model: white noise and no floors,
// so that every cause is named that is more probable than none. All are taken as equally common.
inline DiagnoseOptions LaboratoryOptions() {
  DiagnoseOptions options;
  options.noise = ErrorSpec();
  options.priors = {{}, true, "alike"};
  options.probability = 0.5;
  options.floor_current = options.floor_power = 0;
  return options;
}

// Parse and print option values for the table below: the base model, ids of effects, ids of own
// effects. Errors: any other base than sd or dd; a malformed list.
Expected<void> ReadBaseModel(const std::string& text, DiagnoseOptions* options, const TextReaders&);
Expected<void> ReadEffectIds(const std::string& text, DiagnoseOptions* options, const TextReaders&);
std::vector<std::string> OwnEffectIds(const DiagnoseOptions& options);

inline constexpr OptionRow<DiagnoseOptions> kDiagnoseOptionTable[] = {
    OptionRow<DiagnoseOptions>("Diagnosis"),
    {"base", "NAME", "the model that is diagnosed: sd, or dd with n2 = 2",
     OptionText<DiagnoseOptions>{ReadBaseModel,
                                 [](const DiagnoseOptions& options) -> std::vector<std::string> {
                                   return {ToText(options.base)};
                                 }}},
    {"noise", "NAME|FILE",
     "errors of the readings: white, each its own; field, beside it light that wanders and a "
     "module that departs from the model; or a JSON file with their sizes",
     NoiseOption<&DiagnoseOptions::noise>()},
    {"effects", "ID[,ID]", "those to try",
     OptionText<DiagnoseOptions>{ReadEffectIds,
                                 [](const DiagnoseOptions& options) -> std::vector<std::string> {
                                   if (options.effects.empty()) return {"all"};
                                   return {JoinList(options.effects)};
                                 }},
     OptionTrait::kNone, ": all that the data can show"},
    {"own-effects", "", "effects of one's own", OptionText<DiagnoseOptions>{nullptr, OwnEffectIds},
     OptionTrait::kNoFlag},
    {"probability", "P", "smallest probability at which a cause is named",
     &DiagnoseOptions::probability, 0.5, 0.999},
    {"priors", "NAME|FILE",
     "how common causes are: table, for the field; alike, all equally; or a JSON file like "
     "{\"shading\": 0.1}",
     PriorsOption<&DiagnoseOptions::priors>()},
    {"setup", "NAME", "where it was measured, which decides what can disturb it",
     EnumOption<&DiagnoseOptions::setup>(), OptionTrait::kNone, ": as the file says"},
    {"age", "YEARS", "of the device in the field: some causes are of old devices",
     &DiagnoseOptions::age_years, 0, 100},
    {"seed", "", "seed of the search", &DiagnoseOptions::seed, 0, 1.8446744073709552e19},
    {"floor-current", "", "smallest effect that is named, in parts of Isc (rms over the curve)",
     &DiagnoseOptions::floor_current, 0, 1},
    {"floor-power", "", "smallest effect that is named, in parts of Pmax",
     &DiagnoseOptions::floor_power, 0, 1},
    {"largest-causes", "", "most causes that are named", &DiagnoseOptions::largest_causes, 1, 8},
    {"folds", "", "parts that are left out in turn to measure the gain", &DiagnoseOptions::folds, 2,
     100},
    {"held-out", "", "do not measure the gain on readings that were not fitted",
     &DiagnoseOptions::held_out},
    {"extend", "", "search and polish the extended model", &DiagnoseOptions::extend,
     OptionTrait::kNoFlag | OptionTrait::kNoEcho},
    {"threads", "N", "0: all cores; never changes a result", &DiagnoseOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoEcho},
};

}  // namespace lyrefit
