#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/study/report/documents.h"
#include "sample_audit.h"

namespace lyrefit {
namespace {

TEST(AuditText, SaysWhatTheGoldenFileHas) {
  Golden golden("audit");
  const auto add = [&](const std::string& title, const auto& change) {
    AuditReport report = SampleAudit();
    change(&report);
    golden.AddChanges(title, AuditText(report));
  };
  golden.Add("two tables", AuditText(SampleAudit()));
  add("claims of the solved current",
      [](AuditReport* report) { report->options.objective = Objective::kSolvedCurrent; });
  add("one row claims the solved current", [](AuditReport* report) {
    report->findings[0].row.objective = Objective::kSolvedCurrent;
    report->findings[0].stated.objective = Objective::kSolvedCurrent;
  });
  add("a claim without parameters", [](AuditReport* report) {
    AuditFinding& finding = report->findings[0];
    finding.verdict = AuditVerdict::kNoParameters;
    finding.row.sum_of_squares = true;
    finding.stated.parameters.clear();
    finding.stated.constants.clear();
    finding.stated.rmse = {};
  });
  add("stated constants", [](AuditReport* report) {
    for (AuditFinding& finding : report->findings) finding.stated.any_constants = false;
  });
  add("no algorithm", [](AuditReport* report) { report->findings[2].row.algorithm.clear(); });
  add("a long algorithm", [](AuditReport* report) {
    report->findings[2].row.algorithm = "a comprehensive \u00e4lgorithm [74]";
  });
  add("a long algorithm, cut beside a letter of two bytes", [](AuditReport* report) {
    report->findings[2].row.algorithm = "abcdefghijklmn\u00e4opqrst";
  });
  add("a long sentence", [](AuditReport* report) {
    report->findings[2].sentence =
        std::string(40, 'a') + " " + std::string(80, 'b') + " and more of it";
  });
  golden.AddLong("in brief", BriefAudit(SampleAudit()));
  golden.Check();
}

}  // namespace
}  // namespace lyrefit
