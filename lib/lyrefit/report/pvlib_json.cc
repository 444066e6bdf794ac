#include "lyrefit/report/pvlib_json.h"

#include "lyrefit/base/version.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

constexpr char kCells[] = "cells_in_series";

Json ValuesJson(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& value : values) json[value.name] = Number(value.value);
  if (const auto cells = json.find(kCells); cells != json.end() && cells->is_number()) {
    *cells = static_cast<int>(cells->get<double>());
  }
  return json;
}

// Puts each value where its function takes it: what calcparams does not know raises a TypeError.
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

// The row begins as SAM's own do.
Json RowJson(const CecModule& module) {
  Json json = {{"Name", module.name}, {"Technology", module.technology}};
  json.update(ValuesJson(module.values));
  return json;
}

}  // namespace

std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec) {
  Json json;
  json["lyrefit_version"] = Version();
  json["name"] = name;
  const bool pvsyst = law == TranslationLaw::kPvsyst;
  json["function"] = pvsyst ? "calcparams_pvsyst" : "calcparams_desoto";
  AddKeywords(ValuesJson(keywords), pvsyst, &json);
  json["cec"] = cec ? RowJson(*cec) : Json(nullptr);
  json["cec_reason"] = cec ? std::string() : cec.error().message;
  // Names and files may hold bytes that are not UTF-8.
  return JsonText(json);
}

}  // namespace lyrefit
