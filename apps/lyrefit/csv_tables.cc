#include "csv_tables.h"

#include <algorithm>

#include "lyrefit/report/csv_parts.h"

namespace lyrefit {
namespace {

std::string YesNo(bool value) { return value ? "yes" : "no"; }

// One line of fields that are texts already.
std::string CsvLine(const std::vector<std::string>& fields) {
  std::string line = fields.front();
  for (std::size_t i = 1; i < fields.size(); ++i) line += "," + fields[i];
  return line + "\n";
}

std::string SizedFields(const Sized& sized) {
  return CsvField(sized.value) + "," + CsvField(sized.low_95) + "," + CsvField(sized.high_95);
}

std::string JoinWith(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
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
                  CsvField(cause.corrected_p), CsvField(StrengthText(cause)),
                  CsvField(JoinWith(cause.equivalents, " ")), CsvField(cause.sentence)});
}

}  // namespace

std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses) {
  std::string csv =
      "measurement,cause,title,named,current_effect,current_effect_low_95,current_effect_high_95,"
      "power_effect,power_effect_low_95,power_effect_high_95,corrected_p,strength,equivalents,"
      "sentence\n";
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    const Verdict& verdict = diagnoses[i].verdict;
    for (const Cause& cause : verdict.causes) csv += CauseLine(names[i], cause, true);
    for (const Cause& cause : verdict.below_floor) csv += CauseLine(names[i], cause, false);
    if (!verdict.causes.empty() || !verdict.below_floor.empty()) continue;
    csv += CsvLine(
        {CsvField(names[i]), "", "", "no", ",,", ",,", "", "", "", CsvField(verdict.sentence)});
  }
  return csv;
}

std::string OddSweepsCsv(const OddSweeps& odd) {
  std::string csv = "sweep,differs,p_value,cause,size,low_95,high_95,unit,power,sentence\n";
  for (const HealthyComparison& sweep : odd.sweeps) {
    const HealthyCause none{"", "", kUnknown, kUnknown, kUnknown, "", kUnknown, 0};
    const HealthyCause& cause = sweep.causes.empty() ? none : sweep.causes.front();
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

std::string CoverageCsv(const CoverageReport& report) {
  std::string csv =
      "parameter,name,unit,fitted,not_identifiable,counted,covered,coverage,low_95,high_95,"
      "median_half_width\n";
  for (const ParameterCoverage& p : report.parameters) {
    csv += CsvLine({CsvField(p.info.symbol), CsvField(p.info.name), CsvField(p.info.unit),
                    std::to_string(p.fitted), std::to_string(p.not_identifiable),
                    std::to_string(p.counted), std::to_string(p.covered), CsvField(p.coverage),
                    CsvField(p.low_95), CsvField(p.high_95), CsvField(p.median_half_width)});
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
