#include "effect_text.h"

#include <fmt/format.h>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

std::string ParameterText(const EffectParameter& parameter) {
  const std::string unit = *parameter.unit != '\0' ? fmt::format(" ({})", parameter.unit) : "";
  return fmt::format("{}, {}{}", parameter.name, parameter.doc, unit);
}

// Voltages per cell and currents in parts of the measurement's scale, as the equation has them.
std::string BoundsText(const EffectParameter& parameter) {
  return fmt::format("{:g} to {:g}", parameter.lower, parameter.upper);
}

std::string ConfusedText(const Effect& effect) {
  std::string text;
  for (const char* id : effect.confused_with) {
    const Effect* const other = FindEffect(id);
    text += text.empty() ? "" : ", ";
    text += other == nullptr ? id : fmt::format("{} ({})", other->title, id);
  }
  return text.empty() ? "nothing in the catalogue" : text;
}

}  // namespace

std::string EffectIds() {
  std::string known;
  for (const Effect* effect : Catalogue()) {
    known += (known.empty() ? "" : ", ") + std::string(effect->id);
  }
  return known;
}

Expected<void> CheckEffects(const std::string& flag, const std::vector<std::string>& ids) {
  for (const std::string& id : ids) {
    if (FindEffect(id) != nullptr) continue;
    return Fail(fmt::format("{}: expected one of {}, found '{}'", flag, EffectIds(), id));
  }
  return {};
}

Expected<std::string> ExplainEffect(const std::string& id) {
  if (auto checked = CheckEffects("--explain", {id}); !checked) {
    return tl::unexpected(checked.error());
  }
  const Effect& effect = *FindEffect(id);
  std::string text =
      fmt::format("{} ({})\n", effect.title, effect.id) + Wrap("  ", effect.sentence) + "\n" +
      Field("equation", effect.equation) + Field("reference", effect.reference) +
      Field("where", fmt::format("{}; {}", ToText(effect.where), effect.acts)) +
      Field("data needed", effect.needs) + Field("confused with", ConfusedText(effect)) +
      Field("to tell", effect.separate_by);
  if (effect.probes == nullptr)
    text += Field("found", "by looking at values and residuals, not by a fit of its own");
  if (effect.parameters.empty()) return text;
  TextTable table("lll");
  table.Add({"parameter", "bounds", "meaning (unit in reports)"});
  for (const EffectParameter& parameter : effect.parameters) {
    table.Add({parameter.symbol, BoundsText(parameter), ParameterText(parameter)});
  }
  return text + "\n" + table.Text() +
         Wrap("  ",
              "Bounds are of the equation's own units: voltages per cell, currents in parts of "
              "the short-circuit current.");
}

std::string EffectList() {
  TextTable table("lll");
  table.Add({"effect", "title", "where"});
  for (const Effect* effect : Catalogue()) {
    table.Add({effect->id, effect->title, ToText(effect->where)});
  }
  return table.Text() + Wrap("  ", "lyrefit diagnose --explain EFFECT says more of one.");
}

}  // namespace lyrefit
