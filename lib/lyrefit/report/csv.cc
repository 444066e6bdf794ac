#include "lyrefit/report/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "lyrefit/certify/certify.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/read/spreadsheet_text.h"
#include "lyrefit/report/readable.h"
#include "lyrefit/report/record_parts.h"

namespace lyrefit {
namespace {

std::string YesNo(bool value) { return value ? "yes" : "no"; }

std::string JoinWith(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

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
  fields.push_back(CsvField(JoinWith(report.warnings, "; ")));
  fields.push_back("");
  return fields;
}

std::string SizedFields(const Sized& sized) {
  return CsvField(sized.value) + "," + CsvField(sized.low_95) + "," + CsvField(sized.high_95);
}

std::string StrengthText(const Cause& cause) {
  std::vector<std::string> texts;
  for (const CauseParameter& p : cause.strength) {
    texts.push_back(p.symbol + "=" + CsvField(p.value) + (p.unit.empty() ? "" : " " + p.unit));
  }
  return JoinWith(texts, "; ");
}

std::string CauseLine(const std::string& name, const Cause& cause, bool named) {
  return CsvLine({CsvField(name), CsvField(cause.id), CsvField(cause.title), YesNo(named),
                  SizedFields(cause.current_effect), SizedFields(cause.power_effect),
                  SizedFields(cause.recoverable_power_W), CsvField(cause.probability),
                  CsvField(StrengthText(cause)), CsvField(JoinWith(cause.equivalents, " ")),
                  CsvField(cause.sentence)});
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

std::string IndividualFitsCsv(const FamilyReport& report) {
  const bool two = report.translation.spec.model == Model::kDoubleDiode;
  std::string csv =
      "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,cells_in_series";
  if (two) csv += ",saturation_current_2,n_2";
  const std::vector<ParameterInfo> infos = FreeInfos(report);
  const int base = MakeDevice(report.translation.spec.model, {}).size();
  for (std::size_t k = base; k < infos.size(); ++k) csv += "," + infos[k].name;
  csv += "\n";
  for (const FamilyCurve& curve : report.curves) {
    const std::vector<double>& values =
        curve.individual_parameters.empty() ? curve.parameters : curve.individual_parameters;
    const auto field = [&values](int index) {
      const bool there = index < static_cast<int>(values.size());
      return "," + CsvField(there ? values[index] : kUnknown);
    };
    csv += CsvField(curve.id);
    for (const int index : {kIph, SaturationCurrentIndex(0), kRs, kRsh, IdealityIndex(0)}) {
      csv += field(index);
    }
    csv += "," + std::to_string(report.cells_in_series);
    if (two) csv += field(SaturationCurrentIndex(1)) + field(IdealityIndex(1));
    for (int k = base; k < static_cast<int>(infos.size()); ++k) csv += field(k);
    csv += "\n";
  }
  return csv;
}

std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses) {
  std::string csv =
      "measurement,cause,title,named,current_effect,current_effect_low_95,current_effect_high_95,"
      "power_effect,power_effect_low_95,power_effect_high_95,recoverable_power_W,"
      "recoverable_power_W_low_95,recoverable_power_W_high_95,probability,strength,equivalents,"
      "sentence\n";
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    const Verdict& verdict = diagnoses[i].verdict;
    for (const Cause& cause : verdict.causes) csv += CauseLine(names[i], cause, true);
    for (const Cause& cause : verdict.below_floor) csv += CauseLine(names[i], cause, false);
    if (!verdict.causes.empty() || !verdict.below_floor.empty()) continue;
    csv += CsvLine({CsvField(names[i]), "", "", "no", ",,", ",,", ",,", "", "", "",
                    CsvField(verdict.sentence)});
  }
  return csv;
}

std::string OutlierSweepsCsv(const OutlierSweeps& outlier) {
  std::string csv = "sweep,differs,p_value,cause,size,low_95,high_95,unit,power,sentence\n";
  for (const ReferenceComparison& sweep : outlier.sweeps) {
    const ReferenceCause none{"", "", kUnknown, kUnknown, kUnknown, "", kUnknown, 0};
    const ReferenceCause& cause = sweep.causes.empty() ? none : sweep.causes.front();
    csv += CsvLine({CsvField(sweep.name), YesNo(sweep.differs), CsvField(sweep.p_value),
                    CsvField(cause.id), CsvField(cause.size), CsvField(cause.low_95),
                    CsvField(cause.high_95), CsvField(cause.unit), CsvField(cause.power),
                    CsvField(sweep.sentence)});
  }
  return csv;
}

std::string CertificateCsv(const Certificate& certificate) {
  std::vector<ParameterInfo> infos;  // of the largest model
  for (const ModelCertificate& model : certificate.models) {
    const Device device = MakeDevice(model.model, certificate.curve.conditions);
    if (device.parameters.size() > infos.size()) infos = device.parameters;
  }
  std::string csv = "model,certified,rmse_A,lower_bound_A,gap,above_floor";
  for (const ParameterInfo& info : infos) {
    csv += "," + CsvField(info.symbol + (info.unit.empty() ? "" : "_" + info.unit));
  }
  csv += "\n";
  const Floor& floor = certificate.floor;
  csv += CsvLine({"floor", YesNo(floor.certified), CsvField(floor.rmse_A),
                  CsvField(floor.lower_bound_A), CsvField(floor.gap), "0"});
  csv.insert(csv.size() - 1, std::string(infos.size(), ','));
  for (const ModelCertificate& model : certificate.models) {
    std::vector<std::string> fields = {ToText(model.model),    YesNo(model.certified),
                                       CsvField(model.rmse_A), CsvField(model.lower_bound_A),
                                       CsvField(model.gap),    CsvField(model.above_floor)};
    for (std::size_t k = 0; k < infos.size(); ++k) {
      fields.push_back(k < model.parameters.size() ? CsvField(model.parameters[k]) : "");
    }
    csv += CsvLine(fields);
  }
  return csv;
}

std::string DataSheetCsv(const DataSheetFit& fit) {
  std::string csv = "parameter,name,unit,value,low,high\n";
  for (std::size_t k = 0; k < fit.shared.size(); ++k) {
    const ParameterInfo& info = fit.translation.parameters[k];
    const auto range =
        std::find_if(fit.ranges.begin(), fit.ranges.end(),
                     [&info](const DataSheetRange& r) { return r.name == info.name; });
    const bool ranged = range != fit.ranges.end();
    csv += CsvLine({CsvField(info.symbol), CsvField(info.name), CsvField(info.unit),
                    CsvField(fit.shared[k]), CsvField(ranged ? range->low : kUnknown),
                    CsvField(ranged ? range->high : kUnknown)});
  }
  return csv;
}

}  // namespace lyrefit
