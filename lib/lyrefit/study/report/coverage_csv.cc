#include "lyrefit/study/report/coverage_csv.h"

#include "lyrefit/report/csv.h"

namespace lyrefit {

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

}  // namespace lyrefit
