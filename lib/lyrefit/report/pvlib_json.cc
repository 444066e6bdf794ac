#include "lyrefit/report/pvlib_json.h"

#include "lyrefit/base/version.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json ValuesJson(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& value : values) json[value.name] = Number(value.value);
  if (const auto cells = json.find("cells_in_series"); cells != json.end() && cells->is_number()) {
    *cells = static_cast<int>(cells->get<double>());
  }
  return json;
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
  json["function"] = law == TranslationLaw::kPvsyst ? "calcparams_pvsyst" : "calcparams_desoto";
  json["parameters"] = ValuesJson(keywords);
  json["cec"] = cec ? RowJson(*cec) : Json(nullptr);
  json["cec_reason"] = cec ? std::string() : cec.error().message;
  // Names and files may hold bytes that are not UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lyrefit
