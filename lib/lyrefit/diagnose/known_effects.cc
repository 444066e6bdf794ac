#include "lyrefit/diagnose/known_effects.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lyrefit/diagnose/circumstances.h"
#include "lyrefit/diagnose/weighted_data.h"
#include "lyrefit/effects/catalogue.h"

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

}  // namespace lyrefit
