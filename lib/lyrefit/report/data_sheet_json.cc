#include "lyrefit/report/data_sheet_json.h"

#include "lyrefit/base/version.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json ParametersJson(const DataSheetFit& fit) {
  Json parameters = Json::object();
  for (int i = 0; i < fit.translation.size(); ++i) {
    const ParameterInfo& info = fit.translation.parameters[i];
    Json one = {{"symbol", info.symbol},
                {"unit", info.unit},
                {"value", Number(fit.shared[i])},
                {"low", nullptr},
                {"high", nullptr}};
    for (const DataSheetRange& range : fit.ranges) {
      if (range.name != info.name) continue;
      one["low"] = Number(range.low);
      one["high"] = Number(range.high);
    }
    parameters[info.name] = std::move(one);
  }
  return parameters;
}

}  // namespace

std::string DataSheetJson(const DataSheetFit& fit) {
  const TranslationSpec& spec = fit.translation.spec;
  Json checks = Json::object();
  for (const DataSheetCheck& check : fit.checks) {
    checks[check.name] = {
        {"unit", check.unit}, {"printed", Number(check.asked)}, {"given", Number(check.given)}};
  }
  Json json;
  json["lyrefit_version"] = Version();
  json["law"] = ToText(spec.law);
  json["model"] = ToText(spec.model);
  json["cells_in_series"] = spec.cells_in_series;
  json["constants"] = ToText(spec.constants);
  json["parameters"] = ParametersJson(fit);
  json["checks"] = std::move(checks);
  json["largest_relative_error"] = Number(fit.largest_relative_error);
  json["warnings"] = fit.warnings;
  return JsonText(json);
}

}  // namespace lyrefit
