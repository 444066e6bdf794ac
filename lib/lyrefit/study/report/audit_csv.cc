#include "lyrefit/study/report/audit_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "lyrefit/report/csv.h"
#include "lyrefit/study/audit_sentence.h"

namespace lyrefit {
std::string AuditCsv(const AuditReport& report) {
  std::string csv =
      "source,device,model,algorithm,claimed_A,measured_current_A,solved_current_A,"
      "tolerance_A,"
      "verdict,constants,changes,changed_A,left_bounds,sentence,objective\n";
  for (const AuditFinding& finding : report.findings) {
    const AuditRow& row = finding.row;
    const AuditReading& stated = finding.stated;
    const bool changed = !finding.explanations.empty();
    const AuditReading& answer = changed ? finding.explanations[0].reading : stated;
    std::string constants;
    for (const ConstantSet set : answer.constants) {
      constants += (constants.empty() ? "" : " ") + ToText(set);
    }
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                   CsvField(row.source), CsvField(row.device), ToText(row.model),
                   CsvField(row.algorithm), CsvField(row.rmse.value),
                   CsvField(stated.rmse.measured_current_A), CsvField(stated.rmse.solved_current_A),
                   CsvField(stated.tolerance_A), ToText(finding.verdict), constants,
                   CsvField(JoinedChanges(answer)), changed ? CsvField(answer.figure_A) : "",
                   CsvField(LeftBoundsText(answer.left_bounds)), CsvField(finding.sentence),
                   ToText(stated.objective));
  }
  return csv;
}

}  // namespace lyrefit
