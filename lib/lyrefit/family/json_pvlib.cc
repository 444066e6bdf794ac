#include <utility>

#include "lyrefit/base/version.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

constexpr char kCells[] = "cells_in_series";

Json NamedJson(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& value : values) json[value.name] = value.value;
  if (const auto cells = json.find(kCells); cells != json.end()) {
    *cells = static_cast<int>(cells->get<double>());
  }
  return json;
}

// Sorts values by pvlib function: calcparams_* raises a TypeError for unknown keywords.
void AddKeywords(const Json& values, bool pvsyst, Json* json) {
  Json arguments = Json::object(), bishop88 = Json::object();
  for (const auto& [name, value] : values.items()) {
    if (name == kCells) (*json)[kCells] = value;
    if (name == "d2mutau" || name == "NsVbi") {
      bishop88[name] = value;
    } else if (name != kCells || pvsyst) {
      arguments[name] = value;
    }
  }
  (*json)["parameters"] = std::move(arguments);
  if (!bishop88.empty()) (*json)["bishop88"] = std::move(bishop88);
}

}  // namespace

// The row starts with the columns of SAM's own rows.
void to_json(Json& j, const CecModule& module) {
  j = {{"Name", module.name}, {"Technology", module.technology}};
  j.update(NamedJson(module.values));
}

std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec) {
  const bool pvsyst = law == TranslationLaw::kPvsyst;
  Json json = {
      {"lyrefit_version", Version()}, {"name", name}, {"function", "calcparams_" + ToText(law)}};
  AddKeywords(NamedJson(keywords), pvsyst, &json);
  json["cec"] = cec ? Json(*cec) : Json();
  json["cec_reason"] = cec ? std::string() : cec.error().message;
  return Dump(json);
}

}  // namespace lyrefit
