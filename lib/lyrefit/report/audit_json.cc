#include "lyrefit/report/audit_json.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

template <class T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json ConstantsOrNull(const std::optional<ConstantSet>& constants) {
  return constants ? Json(ToText(*constants)) : Json(nullptr);
}

// Rounded where the subtraction from kelvin leaves 33.00000000000006.
Json Celsius(double value) { return std::round(value * 1e9) / 1e9; }

Json LeftBoundsJson(const std::vector<LeftBound>& left) {
  Json list = Json::array();
  for (const LeftBound& bound : left) {
    list.push_back({{"name", bound.info.name},
                    {"symbol", bound.info.symbol},
                    {"value", bound.value},
                    {"lower", bound.lower},
                    {"upper", bound.upper}});
  }
  return list;
}

Json ReadingJson(const AuditReading& reading, const Device& device) {
  Json constants = Json::array();
  for (const ConstantSet set : reading.constants) constants.push_back(ToText(set));
  Json parameters = Json::object();
  for (int i = 0; i < device.size(); ++i) {
    parameters[device.parameters[i].name] = reading.parameters[i];
  }
  return {{"changes", reading.changes},
          {"curve", reading.curve},
          {"cell_temperature_C", Celsius(reading.temperature_C)},
          {"cells_in_series", reading.cells},
          {"objective", ToText(reading.objective)},
          {"constants", std::move(constants)},
          {"constants_shown", ToText(reading.shown)},
          {"parameters", std::move(parameters)},
          {"rmse",
           {{"measured_current_A", reading.rmse.measured_current_A},
            {"solved_current_A", reading.rmse.solved_current_A}}},
          {"tolerance_A", reading.tolerance_A},
          {"left_bounds", LeftBoundsJson(reading.left_bounds)}};
}

Json ExplanationJson(const AuditExplanation& explanation, const Device& device) {
  Json json = ReadingJson(explanation.reading, device);
  json["low_temperature_C"] = Celsius(explanation.low_temperature_C);
  json["high_temperature_C"] = Celsius(explanation.high_temperature_C);
  json["readings_tried"] = explanation.readings_tried;
  json["accidental_matches"] = explanation.chance;
  return json;
}

Json TemperaturesJson(const std::optional<AuditTemperatures>& temperatures) {
  if (!temperatures) return nullptr;
  Json at_claim = Json::array();
  for (const double celsius : temperatures->at_claim_C) at_claim.push_back(celsius);
  return {{"at_claim_C", std::move(at_claim)},
          {"best_C", Celsius(temperatures->best_C)},
          {"best_rmse_A", temperatures->best_A}};
}

Json RowJson(const AuditRow& row) {
  return {
      {"line", row.line},
      {"source", row.source},
      {"device", row.device},
      {"model", ToText(row.model)},
      {"algorithm", row.algorithm},
      {"note", row.note},
      {"claimed",
       {{"text", row.rmse.text}, {"rmse_A", row.rmse.value}, {"half_unit_A", row.rmse.half_unit}}},
      {"temperature_C", OrNull(row.temperature_C)},
      {"cells_in_series", OrNull(row.cells)},
      {"constants", ConstantsOrNull(row.constants)}};
}

Json FindingJson(const AuditFinding& finding) {
  const Device device = MakeDevice(finding.row.model, {});
  Json explanations = Json::array();
  for (const AuditExplanation& explanation : finding.explanations) {
    explanations.push_back(ExplanationJson(explanation, device));
  }
  return {{"row", RowJson(finding.row)},
          {"verdict", ToText(finding.verdict)},
          {"sentence", finding.sentence},
          {"bounds", finding.bounds_name.empty() ? Json(nullptr) : Json(finding.bounds_name)},
          {"stated", ReadingJson(finding.stated, device)},
          {"explanations", std::move(explanations)},
          {"nearest", finding.nearest ? ExplanationJson(*finding.nearest, device) : Json(nullptr)},
          {"temperatures", TemperaturesJson(finding.temperatures)},
          {"short_circuit_current_A", finding.short_circuit_A},
          {"other_device",
           finding.other_device ? ReadingJson(*finding.other_device, device) : Json(nullptr)},
          {"optimum_rmse_A", finding.optimum_A}};
}

}  // namespace

std::string AuditJson(const AuditReport& report) {
  Json json;
  json["lyrefit_version"] = report.version;
  json["rows_file"] = report.path;
  json["objective"] = ToText(report.options.objective);
  json["constants"] = ConstantsOrNull(report.options.constants);
  json["findings"] = Json::array();
  for (const AuditFinding& finding : report.findings) {
    json["findings"].push_back(FindingJson(finding));
  }
  json["bad_rows"] = Json::array();
  for (const Error& error : report.bad_rows) {
    json["bad_rows"].push_back({{"message", error.message},
                                {"file", error.file},
                                {"line", error.line},
                                {"column", error.column}});
  }
  json["summary"] = Json::object();
  for (const auto& row : EnumTable<AuditVerdict>::kRows) {
    std::string key(row.text);
    std::replace(key.begin(), key.end(), ' ', '_');
    json["summary"][key] = CountFindings(report, row.value);
  }
  // Rows and paths may hold bytes that are not UTF-8.
  return Dump(json);
}

}  // namespace lyrefit
