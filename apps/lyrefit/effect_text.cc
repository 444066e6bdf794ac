#include "effect_text.h"

#include <fmt/format.h>

#include "lyrefit/base/try.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/report/document.h"

namespace lyrefit {
namespace {

std::string ParameterText(const EffectParameter& parameter) {
  const std::string unit = *parameter.unit != '\0' ? fmt::format(" ({})", parameter.unit) : "";
  return fmt::format("{}, {}{}", parameter.name, parameter.doc, unit);
}

// Range of a parameter in the units of the effect's equation: voltages per cell, currents relative
// to the measurement's scale.
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

Section ParameterSection(const Effect& effect) {
  Section section;
  if (effect.parameters.empty()) return section;
  block::Table table = {"lll", {{"parameter", "bounds", "meaning (unit in reports)"}}};
  for (const EffectParameter& parameter : effect.parameters) {
    table.rows.push_back({parameter.symbol, BoundsText(parameter), ParameterText(parameter)});
  }
  AddTable(std::move(table), &section);
  AddSentence(
      "Bounds are of the equation's own units: voltages per cell, currents in parts of the "
      "short-circuit current.",
      &section);
  return section;
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
  TRY(CheckEffects("--explain", {id}));
  const Effect& effect = *FindEffect(id);
  Document document;
  document.head.heading = fmt::format("{} ({})", effect.title, effect.id);
  AddSentence(effect.sentence, &document.head);
  Section law;
  AddField("equation", effect.equation, &law);
  AddField("reference", effect.reference, &law);
  AddField("where", fmt::format("{}; {}", GroupOf(effect), effect.acts), &law);
  AddField("data needed", effect.needs, &law);
  AddField("confused with", ConfusedText(effect), &law);
  AddField("to tell", effect.separate_by, &law);
  AddField("to do", effect.action, &law);
  if (*effect.fact_sheet != '\0') {
    AddField("fact sheet", fmt::format("{} of IEA-PVPS T13-30:2025", effect.fact_sheet), &law);
  }
  if (effect.probes == nullptr) {
    AddField("found", "by looking at values and residuals, not by a fit of its own", &law);
  }
  AddSections({law, ParameterSection(effect)}, &document);
  return DrawText(document);
}

std::string EffectList() {
  block::Table table = {"llll", {{"effect", "title", "of the", "fact sheet"}}};
  block::Table actions = {"lw", {{"effect", "to do"}}};
  for (const Effect* effect : Catalogue()) {
    table.rows.push_back({effect->id, effect->title, GroupOf(*effect), effect->fact_sheet});
    actions.rows.push_back({effect->id, effect->action});
  }
  Document document;
  AddTable(std::move(table), &document.head);
  AddSentence(
      "lyrefit diagnose --explain EFFECT says more of one. Fact sheets: IEA-PVPS T13-30:2025.",
      &document.head);
  Section to_do;
  AddTable(std::move(actions), &to_do);
  AddSections({to_do}, &document);
  return DrawText(document);
}

}  // namespace lyrefit
