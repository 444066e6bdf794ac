#include "lyrefit/diagnose/priors.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {

namespace {

bool InFlasher(const Circumstances& at) { return at.setup == Setup::kFlash; }
bool InInverter(const Circumstances& at) { return at.setup == Setup::kInverter; }
bool SlowOutdoors(const Circumstances& at) { return at.setup == Setup::kOutdoor && at.slow; }
bool ModuleInLaboratory(const Circumstances& at) {
  return at.setup == Setup::kLaboratory && at.module;
}
bool New(const Circumstances& at) { return at.age_years && *at.age_years < 1; }
bool Old(const Circumstances& at) { return at.age_years && *at.age_years > 10; }
bool ThinFilm(const Circumstances& at) { return at.module && IsThinFilm(at.technology); }
bool Heterojunction(const Circumstances& at) {
  const Technology* const known = FindTechnology(at.technology);
  return known != nullptr && known->name == std::string_view("HJT");
}

}  // namespace

const std::vector<PriorFactor>& PriorFactorTable() {
  static const char* const kPulse = "the light of a flash is held or recorded within milliseconds";
  static const char* const kCold = "a flash does not warm the cells";
  static const char* const kUnlike =
      "nothing shades a flasher: cells that give less, as common as weak cells";
  static const char* const kOpen =
      "an open diode shows only beside cells that give less, and these are rarer than in shade";
  static const char* const kRoom = "nothing shades a laboratory unless it is put there";
  static const char* const kLaboratoryLamp = "lamps falter less than the sky: as in cells";
  static const char* const kRegisters = "registers of an inverter hold whole steps";
  static const char* const kSlow =
      "a sweep of half a second or more is slower than cells charge (friesen1997)";
  static const char* const kInfant =
      "IEA PVPS T13-01:2014, section 6: infant failures are glass, interconnects and handling; "
      "corrosion and potential-induced degradation take years";
  static const char* const kWorn =
      "IEA PVPS T13-01:2014, section 6, and Jordan et al. 2017, doi:10.1002/pip.2866: corrosion, "
      "interconnects and diodes of modules over ten years";
  static const char* const kFilms = "non-ohmic shunts are in every thin film (dongaonkar2010)";
  static const char* const kFingers = "thin films have no fingers that corrode: T13-01, section 5";
  static const char* const kCharge = "the charge of a junction grows with exp(Voc): friesen1997";
  static const std::vector<PriorFactor> table = {
      {"irr_step", InFlasher, 0, kPulse},
      {"transient", InFlasher, 0, kPulse},
      {"cloud_edge", InFlasher, 0, kPulse},
      {"drift", InFlasher, 0, kPulse},
      {"temp_drift", InFlasher, 0, kCold},
      {"shading", InFlasher, 0.2, kUnlike},
      {"substrings", InFlasher, 0.25, kUnlike},
      {"covered_edge", InFlasher, 0.05, kUnlike},
      {"bypass_open", InFlasher, 0.2, kOpen},
      {"shading", ModuleInLaboratory, 0.1, kRoom},
      {"substrings", ModuleInLaboratory, 0.1, kRoom},
      {"covered_edge", ModuleInLaboratory, 0.02, kRoom},
      {"bypass_open", ModuleInLaboratory, 0.1, kOpen},
      {"irr_step", ModuleInLaboratory, 0.15, kLaboratoryLamp},
      {"transient", ModuleInLaboratory, 0.4, kLaboratoryLamp},
      {"quantisation", InInverter, 0, kRegisters},
      {"voltage_bins", InInverter, 0, kRegisters},
      {"capacitance", SlowOutdoors, 0, kSlow},
      {"capacitance", Heterojunction, 3, kCharge},
      {"nonohmic_shunt", ThinFilm, 30, kFilms},
      {"aged_contacts", ThinFilm, 0.3, kFingers},
      {"aged_contacts", New, 0.1, kInfant},
      {"graded_shunt", New, 0.1, kInfant},
      {"aged_contacts", Old, 3, kWorn},
      {"bypass_short", Old, 2, kWorn},
      {"bypass_open", Old, 2, kWorn},
      {"open_substring", Old, 2, kWorn},
  };
  return table;
}

const char* WhyNotThere(const std::string& id, const Circumstances& where) {
  for (const PriorFactor& one : PriorFactorTable()) {
    if (one.factor == 0 && id == one.id && one.holds(where)) return one.source;
  }
  return nullptr;
}

double CausePriors::Of(const Effect& effect, bool module) const {
  if (const auto at = given.find(effect.id); at != given.end()) return at->second;
  double prior = module ? effect.prior.in_modules : effect.prior.in_cells;
  if (alike || prior == 0) return kOtherPrior;
  for (const PriorFactor& one : PriorFactorTable()) {
    const bool of_it = std::string_view(effect.id) == one.id;
    if (one.factor > 0 && of_it && one.holds(where)) prior *= one.factor;
  }
  return prior;
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
