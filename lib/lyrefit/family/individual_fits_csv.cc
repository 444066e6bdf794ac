#include "lyrefit/base/numbers.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/family_parts.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

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

}  // namespace lyrefit
