#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/study/audit_evidence.h"
#include "lyrefit/study/report/documents.h"

namespace lyrefit {

void to_json(Json& j, const LeftBound& bound) {
  j = bound.info;
  j.update({{"value", bound.value}, {"lower", bound.lower}, {"upper", bound.upper}});
}

void to_json(Json& j, const AuditTemperatures& temperatures) {
  j = {{"at_claim_C", temperatures.at_claim_C},
       {"best_C", RoundCelsius(temperatures.best_C)},
       {"best_rmse_A", temperatures.best_A}};
}

void to_json(Json& j, const AuditRow& row) {
  LYREFIT_PUT_FIELDS(j, row, line, source, device, model, algorithm, note);
  j["claimed"] = Json{{"text", row.rmse.text},
                      {"sum_of_squares", row.sum_of_squares},
                      {"rmse_A", row.rmse.value},
                      {"half_unit_A", row.rmse.half_unit}};
  LYREFIT_PUT_FIELDS(j, row, objective, temperature_C);
  j["cells_in_series"] = row.cells;
  j["constants"] = row.constants;
}

void to_json(Json& j, const AuditLowest& lowest) {
  LYREFIT_PUT_FIELDS(j, lowest, objective, rmse_A, lower_bound_A, reached_A, n_lower, n_upper);
  j["other_objective_rmse_A"] = lowest.other_objective_A;
  j["newton_step_rmse_A"] = lowest.newton_step_A;
}

// A row that could not be read.
LYREFIT_JSON_FIELDS(Error, message, file, line, column)

namespace {

Json ReadingJson(const AuditReading& reading, const Device& device) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < reading.parameters.size(); ++i) {
    parameters[device.parameters[i].name] = reading.parameters[i];
  }
  return {{"changes", reading.changes},
          {"curve", reading.curve},
          {"cell_temperature_C", RoundCelsius(reading.temperature_C)},
          {"cells_in_series", reading.cells},
          {"objective", reading.objective},
          {"newton_step", reading.newton_step},
          {"constants", reading.constants},
          {"constants_shown", reading.shown},
          {"parameters", std::move(parameters)},
          {"rmse", reading.rmse},
          {"figure_A", reading.figure_A},
          {"tolerance_A", reading.tolerance_A},
          {"left_bounds", reading.left_bounds}};
}

Json ExplanationJson(const AuditExplanation& explanation, const Device& device) {
  Json json = ReadingJson(explanation.reading, device);
  json["low_temperature_C"] = RoundCelsius(explanation.low_temperature_C);
  json["high_temperature_C"] = RoundCelsius(explanation.high_temperature_C);
  json["readings_tried"] = explanation.readings_tried;
  json["accidental_matches"] = explanation.chance;
  return json;
}

}  // namespace

void to_json(Json& j, const AuditFinding& finding) {
  const Device device = MakeDevice(finding.row.model, {});
  Json explanations = Json::array();
  for (const AuditExplanation& explanation : finding.explanations) {
    explanations.push_back(ExplanationJson(explanation, device));
  }
  j = {{"row", finding.row},
       {"verdict", finding.verdict},
       {"sentence", finding.sentence},
       {"bounds", finding.bounds_name.empty() ? Json() : Json(finding.bounds_name)},
       {"stated", ReadingJson(finding.stated, device)},
       {"explanations", std::move(explanations)},
       {"nearest", finding.nearest ? ExplanationJson(*finding.nearest, device) : Json()},
       {"temperatures", finding.temperatures},
       {"short_circuit_current_A", finding.short_circuit_A},
       {"other_device", finding.other_device ? ReadingJson(*finding.other_device, device) : Json()},
       {"optimum_rmse_A", finding.optimum_A},
       {"lowest", finding.lowest}};
}

void to_json(Json& j, const AuditReport& report) {
  Json summary = Json::object();
  for (const auto& row : EnumTable<AuditVerdict>::kRows) {
    std::string key(row.text);
    std::replace(key.begin(), key.end(), ' ', '_');
    summary[key] = CountFindings(report, row.value);
  }
  j = {{"lyrefit_version", report.version},     {"rows_file", report.path},
       {"objective", report.options.objective}, {"constants", report.options.constants},
       {"findings", report.findings},           {"bad_rows", report.bad_rows},
       {"summary", std::move(summary)}};
}

std::string AuditJson(const AuditReport& report) { return Dump(report); }

std::string AuditCsv(const AuditReport& report) {
  std::string csv =
      "source,device,model,algorithm,claimed_A,measured_current_A,solved_current_A,"
      "tolerance_A,"
      "verdict,constants,changes,changed_A,left_bounds,sentence,objective\n";
  for (const AuditFinding& finding : report.findings) {
    const AuditRow& row = finding.row;
    const AuditReading& stated = finding.stated;
    const bool changed = !finding.explanations.empty();
    const AuditReading& answer = changed ? finding.explanations[0].reading : stated;
    std::string constants;
    for (const ConstantSet set : answer.constants) {
      constants += (constants.empty() ? "" : " ") + ToText(set);
    }
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                   CsvField(row.source), CsvField(row.device), ToText(row.model),
                   CsvField(row.algorithm), CsvField(row.rmse.value),
                   CsvField(stated.rmse.measured_current_A), CsvField(stated.rmse.solved_current_A),
                   CsvField(stated.tolerance_A), ToText(finding.verdict), constants,
                   CsvField(JoinedChanges(answer)), changed ? CsvField(answer.figure_A) : "",
                   CsvField(LeftBoundsText(answer.left_bounds)), CsvField(finding.sentence),
                   ToText(stated.objective));
  }
  return csv;
}

}  // namespace lyrefit
