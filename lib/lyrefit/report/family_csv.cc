#include "lyrefit/report/family_csv.h"

#include "lyrefit/report/csv_parts.h"

namespace lyrefit {

std::string FreeFitsCsv(const FamilyReport& report) {
  const bool two = report.translation.spec.model == Model::kDoubleDiode;
  std::string csv =
      "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,cells_in_series";
  csv += two ? ",saturation_current_2,n_2\n" : "\n";
  for (const FamilyCurve& curve : report.curves) {
    const std::vector<double>& values =
        curve.free_parameters.empty() ? curve.parameters : curve.free_parameters;
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
    csv += "\n";
  }
  return csv;
}

}  // namespace lyrefit
