#include "lyrefit/report/csv.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/read/spreadsheet_text.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

std::string FitsHead(const std::vector<ParameterInfo>& parameters) {
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

void AddConditions(const IvCurve& curve, std::vector<std::string>* fields) {
  const Conditions& at = curve.conditions;
  fields->push_back(std::to_string(at.cells_in_series));
  fields->push_back(CsvField(std::round((at.cell_temperature_K - kZeroCelsius_K) * 1e9) / 1e9));
  fields->push_back(CsvField(at.irradiance_W_m2));
  fields->push_back(std::to_string(curve.size()));
}

std::vector<std::string> FitRow(const FittedFile& fit,
                                const std::vector<ParameterInfo>& parameters) {
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
  fields.push_back(CsvField(fmt::format("{}", fmt::join(report.warnings, "; "))));
  fields.push_back("");
  return fields;
}

}  // namespace

std::string CsvField(const std::string& text, CsvTexts texts) {
  std::string field = Readable(text);
  if (texts == CsvTexts::kSafe && RunsInSpreadsheets(field)) field.insert(0, 1, '\'');
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string CsvField(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string CsvLine(const std::vector<std::string>& fields) {
  std::string line = fields.front();
  for (std::size_t i = 1; i < fields.size(); ++i) line += "," + fields[i];
  return line + "\n";
}

std::string FitsCsv(const std::vector<FittedFile>& fits) {
  const std::vector<ParameterInfo> parameters = LargestModel(fits);
  std::string csv = FitsHead(parameters);
  for (const FittedFile& fit : fits) csv += CsvLine(FitRow(fit, parameters));
  return csv;
}

}  // namespace lyrefit
