#include "lyrefit/diagnose/known_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/diagnose/priors.h"
#include "lyrefit/diagnose/weighted_data.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

bool HasId(const std::vector<const Effect*>& effects, const std::string& id) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const Effect* effect) { return id == effect->id; });
}

bool HasBounds(const EffectParameter& p) {
  return std::isfinite(p.lower) && std::isfinite(p.upper) && p.lower < p.upper &&
         p.lower <= p.neutral && p.neutral <= p.upper;
}

// Reason why a caller's effect cannot be fitted; empty if it can.
std::string WhyUnfit(const Effect& effect, const std::vector<const Effect*>& known) {
  if (*effect.id == '\0') return "it has no id";
  if (HasId(known, effect.id)) return "another effect has its id";
  if (effect.found_by != FoundBy::kFit && effect.found_by != FoundBy::kRequest) {
    return "an effect of one's own is found by a fit";
  }
  if (effect.parameters.empty()) return "it has no parameters";
  if (effect.size() > kMostEffectParameters) return "it has too many parameters";
  for (const EffectParameter& parameter : effect.parameters) {
    if (HasBounds(parameter)) continue;
    return std::string("the bounds of '") + parameter.symbol +
           "' are not finite or not around its neutral value";
  }
  if (!effect.HasStage()) return "it changes no stage of the law";
  if (effect.probes == nullptr) return "it has no probes to start from";
  return "";
}

}  // namespace

Expected<std::vector<const Effect*>> KnownEffects(const DiagnoseOptions& options, Setup setup) {
  std::vector<const Effect*> known = Catalogue();
  for (const Effect*& effect : known) effect = InWordsOf(setup, effect);
  for (const Effect* effect : options.own_effects) {
    if (effect == nullptr) return Fail("an effect of one's own is missing");
    if (const std::string why = WhyUnfit(*effect, known); !why.empty()) {
      return Fail(std::string("effect '") + effect->id + "': " + why);
    }
    known.push_back(effect);
  }
  for (const std::string& id : options.effects) {
    if (!HasId(known, id)) return Fail("there is no effect '" + id + "'");
  }
  return known;
}

bool IsWanted(const Effect& effect, const DiagnoseOptions& options) {
  const std::vector<std::string>& ids = options.effects;
  return ids.empty() || std::find(ids.begin(), ids.end(), effect.id) != ids.end();
}

const char* WhyExcluded(const Effect& effect, const DiagnoseOptions& options) {
  const bool asked = !options.effects.empty() || options.priors.given.count(effect.id) != 0;
  return asked ? nullptr : WhyNotThere(effect, options.priors.where);
}

std::vector<const Effect*> Candidates(const std::vector<const Effect*>& known,
                                      const DataTraits& traits, const DiagnoseOptions& options) {
  std::vector<const Effect*> candidates;
  for (const Effect* effect : known) {
    const bool unasked = effect->found_by == FoundBy::kRequest && options.effects.empty();
    const bool in_base = effect->diode > 0 && effect->diode <= static_cast<int>(options.base);
    if (unasked || in_base || effect->found_by == FoundBy::kValues) continue;
    if (WhyExcluded(*effect, options) != nullptr) continue;
    if (IsWanted(*effect, options) && !effect->WhyNot(traits)) candidates.push_back(effect);
  }
  return candidates;
}

namespace {

// Effects of unlike cells, as a flasher shows them.
std::map<const Effect*, Effect> MakeUnlikeCells() {
  std::map<const Effect*, Effect> all;
  const auto add = [&](const char* id) -> Effect& {
    const Effect* const usual = FindEffect(id);
    Effect& own = all.emplace(usual, *usual).first->second;
    own.action =
        "take an electroluminescence image and look for cracked, inactive or degraded cells; check "
        "that the lamp lights the module evenly";
    own.separate_by =
        "flash the module turned end for end: what the lamp does stays, what the cells do turns "
        "with them; an electroluminescence image; of a bifacial module the other face, since "
        "polarisation (PID-p) is of one";
    return own;
  };
  for (const char* id : {"weak_cell", "mismatch", "scatter"}) add(id);
  add("dim_cells").title = "cells that each give another current";
  for (const char* id : {"shading", "substrings", "covered_edge"}) {
    Effect& own = add(id);
    own.finding = "weak_cell";
    own.title = "substrings that give unlike currents";
    own.sentence =
        "cells of a substring give less current than the others, and its bypass diode conducts";
    own.fact_sheet = "PVFS 1-19";
  }
  Effect& every = all.at(FindEffect("covered_edge"));
  every.title = "cells of every substring that give less";
  every.sentence = "cells of every substring give less current than the others";
  return all;
}

}  // namespace

JudgedSetup SetupOf(const CurveSet& set, const DiagnoseOptions& options) {
  JudgedSetup judged{options.setup, "stated", "--setup"};
  if (judged.setup != Setup::kUnknown) return judged;
  if (set.curves.empty()) return {};
  const IvCurve& curve = set.curves.front();
  judged = {curve.notes.setup, "file", curve.stated_in.setup};
  if (judged.setup == Setup::kUnknown && IsFlash(curve)) {
    judged = {Setup::kFlash, "file", "its times, with the light of each reading"};
  }
  // Simulators of single cells burn steadily; those of modules flash.
  if (judged.setup == Setup::kFlash && curve.cells_known && curve.conditions.cells_in_series == 1 &&
      !IsFlash(curve)) {
    judged.setup = Setup::kLaboratory;
  }
  if (judged.setup == Setup::kUnknown) judged = {};
  return judged;
}

Circumstances CircumstancesOf(const Readings& readings, const std::string& technology,
                              const DiagnoseOptions& options) {
  constexpr double kSlow_s = 0.5;
  return {readings.traits.setup, readings.traits.module,
          readings.scale.times && readings.scale.span_s >= kSlow_s, technology, options.age_years};
}

const Effect* InWordsOf(Setup setup, const Effect* effect) {
  if (setup != Setup::kFlash) return effect;
  static const std::map<const Effect*, Effect> unlike = MakeUnlikeCells();
  const auto own = unlike.find(effect);
  return own != unlike.end() ? &own->second : effect;
}

const char* WhyNotThere(const Effect& effect, const Circumstances& where) {
  for (const PriorFactor& one : effect.prior.factors) {
    if (one.factor == 0 && one.holds(where)) return one.source;
  }
  return nullptr;
}

double CausePriors::Of(const Effect& effect, bool module) const {
  if (const auto at = given.find(effect.id); at != given.end()) return at->second;
  double prior = module ? effect.prior.in_modules : effect.prior.in_cells;
  if (alike || prior == 0) return kOtherPrior;
  for (const PriorFactor& one : effect.prior.factors) {
    if (one.factor > 0 && one.holds(where)) prior *= one.factor;
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
