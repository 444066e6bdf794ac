#include "lyrefit/report/fits_table.h"

#include <algorithm>

#include "lyrefit/report/csv_parts.h"
#include "lyrefit/report/json_parts.h"

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

// Value and standard error of the parameter with this symbol.
void AddParameter(const FitReport& report, const ParameterInfo& info,
                  std::vector<std::string>* fields) {
  const auto found = std::find_if(report.estimates.begin(), report.estimates.end(),
                                  [&](const Estimate& e) { return e.info.symbol == info.symbol; });
  const bool there = found != report.estimates.end();
  const double value = !there ? kUnknown : report.polished ? found->refined : found->searched;
  fields->push_back(CsvField(value));
  fields->push_back(CsvField(there ? found->standard_error : kUnknown));
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
  for (const ParameterInfo& info : parameters) AddParameter(report, info, &fields);
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

}  // namespace

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
