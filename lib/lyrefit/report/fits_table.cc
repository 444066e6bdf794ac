#include "lyrefit/report/fits_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/version.h"
#include "lyrefit/report/csv_parts.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// The parameters of the largest model: those of a smaller one are its first.
std::vector<ParameterInfo> LargestModel(const std::vector<FittedFile>& fits) {
  const std::vector<Estimate>* largest = nullptr;
  for (const FittedFile& fit : fits) {
    if (!fit.report) continue;
    const bool larger = largest == nullptr || fit.report->estimates.size() > largest->size();
    if (larger) largest = &fit.report->estimates;
  }
  std::vector<ParameterInfo> parameters;
  if (largest == nullptr) return parameters;
  for (const Estimate& estimate : *largest) parameters.push_back(estimate.info);
  return parameters;
}

std::string Header(const std::vector<ParameterInfo>& parameters) {
  std::string line =
      "file,name,model,objective,cells_in_series,temperature_C,irradiance_Wm2,points";
  for (const ParameterInfo& info : parameters) {
    const std::string column =
        std::string(info.symbol) + (info.unit.empty() ? "" : "_" + std::string(info.unit));
    line.append(",").append(column).append(",").append(column).append("_se");
  }
  for (const char* stage : {"searched", "refined"}) {
    for (const char* objective : {"measured", "solved"}) {
      line += std::string(",rmse_") + stage + "_" + objective + "_current_A";
    }
  }
  return line + ",usable,warnings,error\n";
}

std::string Joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

void AddConditions(const IvCurve& curve, std::vector<std::string>* fields) {
  const Conditions& at = curve.conditions;
  fields->push_back(std::to_string(at.cells_in_series));
  fields->push_back(CsvField(std::round((at.cell_temperature_K - kZeroCelsius_K) * 1e9) / 1e9));
  fields->push_back(CsvField(at.irradiance_W_m2));
  fields->push_back(std::to_string(curve.size()));
}

// The answer of a fit and its standard error for the parameter with this symbol.
std::pair<double, double> ValueAndError(const FitReport& report, const ParameterInfo& info) {
  const auto found = std::find_if(report.estimates.begin(), report.estimates.end(),
                                  [&](const Estimate& e) { return e.info.symbol == info.symbol; });
  if (found == report.estimates.end()) return {kUnknown, kUnknown};
  return {report.polished ? found->refined : found->searched, found->standard_error};
}

std::vector<std::string> Row(const FittedFile& fit, const std::vector<ParameterInfo>& parameters) {
  if (!fit.report) {
    std::vector<std::string> fields(8 + 2 * parameters.size() + 7);
    fields.front() = CsvField(fit.file);
    fields.back() = CsvField(fit.report.error().ToString());
    return fields;
  }
  const FitReport& report = *fit.report;
  std::vector<std::string> fields = {CsvField(fit.file), CsvField(report.curve.name),
                                     ToText(report.model), ToText(report.objective)};
  AddConditions(report.curve, &fields);
  for (const ParameterInfo& info : parameters) {
    const auto [value, error] = ValueAndError(report, info);
    fields.push_back(CsvField(value));
    fields.push_back(CsvField(error));
  }
  const RmsePair refined = report.polished ? report.rmse.refined : RmsePair();
  for (const RmsePair& rmse : {report.rmse.searched, refined}) {
    fields.push_back(CsvField(rmse.measured_current_A));
    fields.push_back(CsvField(rmse.solved_current_A));
  }
  fields.push_back(report.usable ? "true" : "false");
  fields.push_back(CsvField(Joined(report.warnings)));
  fields.push_back("");
  return fields;
}

block::Table::Row TextRow(const FittedFile& fit, const std::vector<ParameterInfo>& parameters) {
  const FitReport& report = *fit.report;
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  block::Table::Row row = {fit.file, ToText(report.model) + PlusEffects(EffectsOf(report.device)),
                           std::to_string(report.curve.size()),
                           Scientific(rmse.measured_current_A, 4),
                           Scientific(rmse.solved_current_A, 4)};
  for (const ParameterInfo& info : parameters) {
    row.push_back(Significant(ValueAndError(report, info).first, 5));
  }
  const std::string marks = BriefMarks(report.interrupted, report.usable, 0);
  row.push_back(report.polished ? marks.substr(marks.empty() ? 0 : 2) : "not polished" + marks);
  return row;
}

}  // namespace

Document FitsDocument(const std::vector<FittedFile>& fits) {
  const std::vector<ParameterInfo> parameters = LargestModel(fits);
  block::Table table = {"llrrr" + std::string(parameters.size(), 'r') + "l",
                        {{"", "", "", "RMSE (A)", "RMSE (A)"},
                         {"file", "model", "points", "measured-current", "solved-current"}}};
  for (const ParameterInfo& info : parameters) {
    table.heads[0].push_back(info.symbol);
    table.heads[1].push_back(info.unit);
  }
  std::vector<std::string> without;
  std::vector<std::string> warnings;
  for (const FittedFile& fit : fits) {
    if (!fit.report) {
      without.push_back(fmt::format("{}: {}", fit.file, fit.report.error().ToString()));
      continue;
    }
    table.rows.push_back(TextRow(fit, parameters));
    for (const std::string& warning : fit.report->warnings) {
      warnings.push_back(fmt::format("{}: {}", fit.file, warning));
    }
  }
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: fits of {}", Version(), Plural(fits.size(), "curve"));
  Section answers = {"Parameters"};
  if (!table.rows.empty()) AddTable(std::move(table), &answers);
  AddSections({answers, ListSection("Not fitted", std::move(without)),
               ListSection("Warnings", std::move(warnings))},
              &document);
  return document;
}

std::string FitsCsv(const std::vector<FittedFile>& fits) {
  const std::vector<ParameterInfo> parameters = LargestModel(fits);
  std::string csv = Header(parameters);
  for (const FittedFile& fit : fits) {
    std::string line;
    for (const std::string& field : Row(fit, parameters)) line += "," + field;
    csv += line.substr(1) + "\n";
  }
  return csv;
}

std::string FitsJson(const std::vector<FittedFile>& fits, JsonPoints points) {
  Json list = Json::array();
  for (const FittedFile& fit : fits) {
    Json item = {{"file", fit.file}};
    if (fit.report) {
      item.update(FitJson(*fit.report, points));
    } else {
      item["error"] = fit.report.error().ToString();
    }
    list.push_back(std::move(item));
  }
  return Dump(list);
}

}  // namespace lyrefit
