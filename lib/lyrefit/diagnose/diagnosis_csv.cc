#include <fmt/format.h>

#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {
namespace {

std::string YesNo(bool value) { return value ? "yes" : "no"; }

// `sized`: a Sized, or a parameter of a cause.
template <class T>
std::string SizedFields(const T& sized) {
  return CsvField(sized.value) + "," + CsvField(sized.low_95) + "," + CsvField(sized.high_95);
}

std::string StrengthText(const Cause& cause) {
  std::vector<std::string> texts;
  for (const CauseParameter& p : cause.strength) {
    texts.push_back(p.symbol + "=" + CsvField(p.value) + (p.unit.empty() ? "" : " " + p.unit));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string CauseLine(const std::string& name, const Cause& cause, bool named) {
  return CsvLine({CsvField(name), CsvField(cause.id), CsvField(cause.title), YesNo(named),
                  SizedFields(cause.current_effect), SizedFields(cause.power_effect),
                  SizedFields(cause.recoverable_power_W), CsvField(cause.probability),
                  CsvField(StrengthText(cause)),
                  CsvField(fmt::format("{}", fmt::join(cause.equivalents, " "))),
                  CsvField(cause.sentence)});
}

}  // namespace

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

std::string OutlierSweepsCsv(const OutlierSweeps& outliers) {
  std::string csv = "sweep,differs,p_value,cause,size,low_95,high_95,unit,power,sentence\n";
  for (const ReferenceComparison& sweep : outliers.sweeps) {
    const ReferenceCause cause = sweep.causes.empty() ? ReferenceCause() : sweep.causes.front();
    const CauseParameter size = cause.strength.empty() ? CauseParameter() : cause.strength.front();
    csv += CsvLine({CsvField(sweep.name), YesNo(sweep.differs), CsvField(sweep.p_value),
                    CsvField(cause.id), SizedFields(size), CsvField(size.unit),
                    CsvField(-cause.power_effect.value), CsvField(sweep.sentence)});
  }
  return csv;
}

}  // namespace lyrefit
