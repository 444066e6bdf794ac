#include "lyrefit/simulate/law_of_report.h"

#include <nlohmann/json.hpp>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

using nlohmann::json;

// The text of a key; empty: none.
std::string ReportText(const json& report, const char* key) {
  const auto at = report.find(key);
  return at != report.end() && at->is_string() ? at->get<std::string>() : std::string();
}

// What the report states of its law; empty: it is not of one law, or of one with effects.
std::optional<TranslationSpec> SpecOfReport(const json& report) {
  const auto law = FromText<TranslationLaw>(ReportText(report, "family"));
  const auto model = FromText<Model>(ReportText(report, "model"));
  const auto shunt = FromText<ShuntLaw>(ReportText(report, "shunt"));
  const auto constants = FromText<ConstantSet>(ReportText(report, "constants"));
  const json cells = report.value("cells_in_series", json());
  const bool plain = report.value("causes", json::array()).empty();
  if (!law || !model || !shunt || !constants || !cells.is_number_integer() || !plain) {
    return std::nullopt;
  }
  TranslationSpec spec;
  spec.law = *law;
  spec.model = *model;
  spec.shunt = *shunt;
  spec.constants = *constants;
  spec.cells_in_series = cells.get<int>();
  spec.recombination = report.value("recombination", json()) == true;
  return spec;
}

}  // namespace

Expected<std::optional<NamedParameters>> LawOfReport(const std::string& text,
                                                     const std::string& path) {
  TRY(const json report, ParseJson(text, path));
  if (!report.is_object() || !report.value("parameters", json()).is_object()) return std::nullopt;
  const std::optional<TranslationSpec> spec = SpecOfReport(report);
  if (!spec) return std::nullopt;
  NamedParameters law;
  law.name = path;
  TRY(law.translation, MakeTranslation(*spec));
  for (const ParameterInfo& info : law.translation.parameters) {
    const json stated = report["parameters"].value(info.name, json::object());
    // The refined value, or the searched one without a polish; null is a perfect shunt.
    json value = stated.value("refined", json());
    if (!value.is_number()) value = stated.value("searched", json());
    const bool shunt = info.kind == ParameterKind::kShunt || info.kind == ParameterKind::kDarkShunt;
    if (!value.is_number() && !(shunt && stated.contains("refined"))) {
      return Fail("expected a number in parameters/" + info.name + "/refined", path);
    }
    law.shared.push_back(value.is_number() ? value.get<double>() : kInfinity);
  }
  return law;
}

}  // namespace lyrefit
