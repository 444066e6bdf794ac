#include "lyrefit/diagnose/priors.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {

const std::vector<CausePrior>& PriorTable() {
  static const char* const kShade = "soiling, snow and shade: most frequent in field sweeps";
  static const char* const kFault = "IEA PVPS T13-01:2014, section 5: failures per module";
  static const char* const kCell = "not rare in cells; modules are sorted, seldom above the floors";
  static const char* const kAllCells =
      "not rare in cells; in all cells of a module alike: thin films";
  static const char* const kSky = "moving clouds: a few in a hundred sweeps of 0.1 to 30 s";
  static const char* const kLamp = "clouds, seldom gone within a sweep; lamps falter less";
  static const char* const kPair = "28 of 44 real pairs of sweeps of thin films";
  static const char* const kTracer = "properties of tracers, per instrument";
  static const std::vector<CausePrior> table = {
      {"second_diode", 0.05, 0.02, kCell},
      {"nonohmic_shunt", 0.03, 0.0003, kAllCells},
      {"breakdown", 0.02, 0.005, kCell},
      {"collection", 0.02, 0.005, kCell},
      {"photoshunt", 0.02, 0.005, kCell},
      {"back_contact", 0.02, 0.01, kCell},
      {"rs_current", 0.01, 0.01, kCell},
      {"distributed_rs", 0.02, 0.02, kCell},
      {"aged_contacts", 0.001, 0.01, kFault},
      {"shading", 0.1, 0.1, kShade},
      {"substrings", 0.08, 0.08, kShade},
      {"covered_edge", 0.08, 0.08, kShade},
      {"weak_cell", 0.02, 0.02, kFault},
      {"dim_cells", 0.01, 0.01, kFault},
      {"mismatch", 0.02, 0.02, kFault},
      {"leaky_cell", 0.01, 0.01, kFault},
      {"scatter", 0.005, 0.003, kFault},
      {"bypass_short", 0.01, 0.01, kFault},
      {"bypass_open", 0.003, 0.006, kFault},
      {"cloud_edge", 0.001, 0.005, kSky},
      {"open_substring", 0.005, 0.01, kFault},
      {"graded_shunt", 0.02, 0.02, kFault},
      {"irr_step", 0.003, 0.02, kLamp},
      {"transient", 0.002, 0.005, kLamp},
      {"drift", 0.01, 0.01, kSky},
      {"temp_drift", 0.003, 0.003, kSky},
      {"hysteresis", 0.1, 0.02, kPair},
      {"capacitance", 0.03, 0.03, kTracer},
      {"timing_skew", 0.02, 0.02, kTracer},
      {"range_switch", 0.005, 0.005, kTracer},
      {"clip", 0.002, 0.002, kTracer},
  };
  return table;
}

double CausePriors::Of(const std::string& id, bool module) const {
  if (const auto at = given.find(id); at != given.end()) return at->second;
  if (alike) return kOtherPrior;
  for (const CausePrior& prior : PriorTable()) {
    if (id == prior.id) return module ? prior.in_modules : prior.in_cells;
  }
  return kOtherPrior;
}

Expected<CausePriors> ReadPriors(const std::string& path) {
  constexpr std::uintmax_t kLargestFile = 1U << 16;
  constexpr char kLike[] = R"({"shading": 0.1, "second_diode": 0.01})";
  TRY(const auto text, ReadTextFile(path, kLargestFile));
  const auto json = ParseJson(text, path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) {
    return Fail(fmt::format("expected probabilities of causes as an object like {}", kLike), path,
                1, 1);
  }
  const JsonFields fields(*json, text, path);
  CausePriors priors;
  priors.name = path;
  for (const auto& [id, value] : json->items()) {
    if (FindEffect(id) == nullptr) return fields.Refuse(id, "the id of an effect");
    const auto number = fields.Number({id.c_str()});
    if (!number) return tl::unexpected(number.error());
    if (!*number || !(**number > 0 && **number < 1)) {
      return fields.Refuse(id, "a probability above 0 and below 1");
    }
    priors.given[id] = **number;
  }
  return priors;
}

Expected<CausePriors> PriorsNamed(const std::string& name) {
  if (name == "table" || name == "alike") return CausePriors{{}, name == "alike", name};
  return ReadPriors(name);
}

}  // namespace lyrefit
