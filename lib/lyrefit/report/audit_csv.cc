#include "lyrefit/report/audit_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "lyrefit/study/audit_sentence.h"

namespace lyrefit {
namespace {

std::string Field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string Field(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string AuditCsv(const AuditReport& report) {
  std::string csv =
      "source,device,model,algorithm,claimed_A,measured_current_A,solved_current_A,tolerance_A,"
      "verdict,constants,changes,changed_A,left_bounds,sentence\n";
  for (const AuditFinding& finding : report.findings) {
    const AuditRow& row = finding.row;
    const AuditReading& stated = finding.stated;
    const bool changed = !finding.explanations.empty();
    const AuditReading& answer = changed ? finding.explanations[0].reading : stated;
    std::string constants;
    for (const ConstantSet set : answer.constants) {
      constants += (constants.empty() ? "" : " ") + ToText(set);
    }
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                   Field(row.source), Field(row.device), ToText(row.model), Field(row.algorithm),
                   Field(row.rmse.value), Field(stated.rmse.measured_current_A),
                   Field(stated.rmse.solved_current_A), Field(stated.tolerance_A),
                   ToText(finding.verdict), constants, Field(JoinedChanges(answer)),
                   changed ? Field(answer.rmse.Of(answer.objective)) : "",
                   Field(LeftBoundsText(answer.left_bounds)), Field(finding.sentence));
  }
  return csv;
}

}  // namespace lyrefit
