#include "lyrefit/diagnose/priors.h"

#include <fmt/format.h>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {

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
