#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/report/csv.h"
#include "studies/coverage.h"
#include "studies/programs.h"
#include "studies/watch.h"

namespace lyrefit {
namespace {

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

}  // namespace

Expected<int> RunCoverage(ProgramFlags flags) {
  CoverageOptions options;
  const std::string csv = Take("csv", "", &flags);
  TRY(TakeTable(kCoverageOptionTable, &flags, &options));
  TRY(CheckNothingLeft(flags));
  if (!flags.files.empty()) return Fail("the sets are made: no curve is read");
  TRY(const CoverageReport report, Coverage(options, FitFamily, Watch));
  if (!csv.empty()) TRY(WriteTextFile(csv, CoverageCsv(report)));
  fmt::print("{}", CoverageText(report));
  if (report.interrupted) return kExitInterrupted;
  return report.failed < static_cast<int>(report.sets.size()) ? 0 : 1;
}

}  // namespace lyrefit
