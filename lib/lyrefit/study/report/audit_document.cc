#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/base/number_text.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/audit_evidence.h"
#include "lyrefit/study/report/documents.h"

namespace lyrefit {
namespace {

constexpr int kAuditDigits = 7;
// In a table; the remarks below it have the full name.
constexpr std::size_t kLongestAlgorithm = 17;

// "Table 10, rtc_france: 33 C, 1 cell in series"
std::string AuditTitle(const AuditFinding& finding) {
  const AuditReading& stated = finding.stated;
  const std::string& source = finding.row.source;
  return fmt::format("{}{}{}: {:g} C, {} in series", source, source.empty() ? "" : ", ",
                     stated.curve, std::round(stated.temperature_C * 1e4) / 1e4,
                     Plural(static_cast<std::size_t>(stated.cells), "cell"));
}

// True if any row states its own objective.
bool ObjectivesVary(const AuditReport& report) {
  return std::any_of(report.findings.begin(), report.findings.end(),
                     [](const AuditFinding& finding) { return finding.row.objective.has_value(); });
}

// Title of a column. A star marks the objective of all claims.
std::string Head(const AuditReport& report, Objective objective) {
  const bool all = !ObjectivesVary(report) && report.options.objective == objective;
  return ToText(objective) + (all ? " *" : "");
}

// A figure. If rows state their own objective, a star marks the figure of that objective.
std::string FigureCell(const AuditReport& report, const AuditFinding& finding,
                       Objective objective) {
  std::string text = Scientific(finding.stated.rmse.Of(objective), kAuditDigits);
  if (!ObjectivesVary(report)) return text;
  return text + (finding.stated.objective == objective ? " *" : "  ");
}

std::string Name(const AuditFinding& finding) {
  return finding.row.algorithm.empty() ? fmt::format("line {}", finding.row.line)
                                       : finding.row.algorithm;
}

// The claim as printed.
std::string Claim(const AuditRow& row) {
  return row.rmse.text + (row.sum_of_squares ? " A^2" : "");
}

std::string ShortName(const AuditFinding& finding) {
  std::string name = Name(finding);
  if (name.size() <= kLongestAlgorithm) return name;
  std::size_t end = kLongestAlgorithm - 2;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
  return name.substr(0, end) + "..";
}

std::string BoundsSentence(const AuditFinding& finding) {
  const auto leaves = [&](const char* when, const AuditReading& reading) {
    return fmt::format(" {} it leaves bounds-{}.json: {}.", when, finding.bounds_name,
                       LeftBoundsText(reading.left_bounds));
  };
  if (finding.explanations.empty()) {
    return finding.stated.left_bounds.empty() ? "" : leaves("As printed", finding.stated);
  }
  const AuditReading& changed = finding.explanations[0].reading;
  return changed.left_bounds.empty() ? "" : leaves("So changed", changed);
}

// Remark on a row below its table; empty for a row without findings.
std::string Remark(const AuditFinding& finding) {
  const bool plain = finding.verdict == AuditVerdict::kReproduces;
  const std::string text = (plain ? "" : finding.sentence) + BoundsSentence(finding);
  return text.empty() ? "" : Name(finding) + ": " + text;
}

// The table of findings begin .. end - 1.
Section CurveSection(const AuditReport& report, std::size_t begin, std::size_t end) {
  block::Table table = {"llrrrl",
                        {{"row", "model", "claimed", Head(report, Objective::kMeasuredCurrent),
                          Head(report, Objective::kSolvedCurrent), "verdict"}}};
  std::vector<std::string> remarks;
  for (std::size_t i = begin; i < end; ++i) {
    const AuditFinding& finding = report.findings[i];
    table.rows.push_back({ShortName(finding), ToText(finding.row.model), Claim(finding.row),
                          FigureCell(report, finding, Objective::kMeasuredCurrent),
                          FigureCell(report, finding, Objective::kSolvedCurrent),
                          ToText(finding.verdict)});
    const std::string remark = Remark(finding);
    if (!remark.empty()) remarks.push_back(remark);
  }
  Section section = {AuditTitle(report.findings[begin]), {std::move(table)}};
  AddList(std::move(remarks), &section);
  return section;
}

std::string Legend(const AuditReport& report) {
  const std::string constants = report.options.constants
                                    ? ToText(*report.options.constants)
                                    : "those that reproduce the claim, or codata where none do";
  return fmt::format(
      "RMSE in A of each row as stated. The constants are {}. The claims are of the RMSE marked *.",
      constants);
}

Section BadRows(const AuditReport& report) {
  std::vector<std::string> errors;
  for (const Error& error : report.bad_rows) errors.push_back(error.ToString());
  const std::string heading = Plural(errors.size(), "row") + " could not be audited";
  return ListSection(heading, std::move(errors));
}

// Number of reproduced claims for each set of constants, over rows that state none.
std::string ConstantsSummary(const AuditReport& report) {
  const bool open =
      std::any_of(report.findings.begin(), report.findings.end(), [](const AuditFinding& finding) {
        return finding.stated.any_constants && !finding.stated.parameters.empty();
      });
  if (!open) return "";
  std::string text;
  for (const auto& row : EnumTable<ConstantSet>::kRows) {
    int count = 0;
    for (const AuditFinding& finding : report.findings) {
      const AuditReading& reading =
          finding.explanations.empty() ? finding.stated : finding.explanations[0].reading;
      if (!reading.any_constants) continue;
      count += static_cast<int>(
          std::count(reading.constants.begin(), reading.constants.end(), row.value));
    }
    text += fmt::format("{}{} with {}", text.empty() ? "" : ", ", count, row.text);
  }
  return fmt::format("Claims that reproduce, by constants: {}.", text);
}

Section Summary(const AuditReport& report) {
  std::string text = Plural(report.findings.size(), "row") + ": ";
  bool first = true;
  for (const auto& row : EnumTable<AuditVerdict>::kRows) {
    const int count = CountFindings(report, row.value);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", first ? "" : ", ", row.text, count);
    first = false;
  }
  if (report.findings.empty()) text += "none audited";
  if (!report.bad_rows.empty()) {
    text += fmt::format("; {} more could not be audited", report.bad_rows.size());
  }
  Section section = {"", {block::Conclusion{text + "."}}};
  const std::string constants = ConstantsSummary(report);
  if (!constants.empty()) section.blocks.push_back(block::Conclusion{constants});
  return section;
}

}  // namespace

Document AuditDocument(const AuditReport& report) {
  Document document;
  document.head = {fmt::format("lyrefit {}: audit of {}", report.version, report.path),
                   {block::Legend{Legend(report)}}};
  const std::vector<AuditFinding>& findings = report.findings;
  for (std::size_t begin = 0; begin < findings.size();) {
    std::size_t end = begin + 1;
    while (end < findings.size() && AuditTitle(findings[end]) == AuditTitle(findings[begin])) ++end;
    AddSections({CurveSection(report, begin, end)}, &document);
    begin = end;
  }
  AddSections({BadRows(report), Summary(report)}, &document);
  return document;
}

std::string AuditText(const AuditReport& report) { return DrawText(AuditDocument(report)); }

std::string BriefAudit(const AuditReport& report) {
  std::string text;
  for (const AuditFinding& finding : report.findings) {
    text += fmt::format(
        "{}{}{}, {} of {}: claimed {}, {} A measured-current, {} A "
        "solved-current: {}\n",
        finding.row.source, finding.row.source.empty() ? "" : ", ", Name(finding),
        ToText(finding.row.model), finding.stated.curve,
        Claim(finding.row) + (finding.row.sum_of_squares ? "" : " A"),
        Scientific(finding.stated.rmse.measured_current_A, kAuditDigits),
        Scientific(finding.stated.rmse.solved_current_A, kAuditDigits), ToText(finding.verdict));
  }
  for (const Error& error : report.bad_rows) text += error.ToString() + "\n";
  return text + DrawText({{}, {}, {Summary(report)}});
}

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
