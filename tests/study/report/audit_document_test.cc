#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lyrefit/report/text_layout.h"
#include "sample_audit.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The text with wrapped lines joined.
std::string WithoutWraps(std::string text) {
  for (std::size_t at; (at = text.find("\n    ")) != std::string::npos;) text.replace(at, 5, " ");
  return text;
}

TEST(AuditText, FitsATerminalOf100Columns) {
  AuditReport report = SampleAudit();
  report.findings[2].sentence =
      std::string(40, 'a') + " " + std::string(80, 'b') + " and more of it";
  std::istringstream lines(AuditText(report));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

TEST(AuditText, ShowsATableForEverySource) {
  const std::string text = AuditText(SampleAudit());
  EXPECT_THAT(text, StartsWith("lyrefit 1.2.3: audit of rows.csv\n"));
  EXPECT_THAT(text, HasSubstr("Table 1, cell: 33 C, 1 cell in series\n"));
  EXPECT_THAT(text, HasSubstr("Table 2, cell: 33 C, 1 cell in series\n"));
  EXPECT_THAT(text, HasSubstr("good  sd     9.8602E-04        9.860219e-04    7.754000e-04  "
                              "reproduces\n"));
}

TEST(AuditText, MarksTheKindOfRmseThatIsClaimed) {
  AuditReport report = SampleAudit();
  EXPECT_THAT(AuditText(report), HasSubstr("measured-current *  solved-current "));
  report.options.objective = Objective::kSolvedCurrent;
  EXPECT_THAT(AuditText(report), HasSubstr("measured-current  solved-current *"));
}

TEST(AuditText, MarksTheFigureWhereRowsSayWhatTheyClaim) {
  AuditReport report = SampleAudit();
  report.findings[0].row.objective = Objective::kSolvedCurrent;
  report.findings[0].stated.objective = Objective::kSolvedCurrent;
  const std::string text = AuditText(report);
  EXPECT_THAT(text, Not(HasSubstr("measured-current *")));
  EXPECT_THAT(text, HasSubstr("9.860219e-04    7.754000e-04 *  reproduces\n"));
  EXPECT_THAT(text, HasSubstr("9.860219e-04 *  7.754000e-04    does not reproduce\n"));
}

TEST(AuditText, ShowsNoFiguresOfAClaimWithoutParameters) {
  AuditReport report = SampleAudit();
  AuditFinding& finding = report.findings[0];
  finding.verdict = AuditVerdict::kNoParameters;
  finding.row.sum_of_squares = true;
  finding.stated.parameters.clear();
  finding.stated.constants.clear();
  finding.stated.rmse = {};
  const std::string text = AuditText(report);
  EXPECT_THAT(text, HasSubstr("9.8602E-04 A^2"));
  EXPECT_THAT(text, HasSubstr("-               -  no parameters\n"));
  EXPECT_THAT(text, HasSubstr("0 with codata, 1 with literature, 0 with paper."));
}

TEST(AuditText, SaysSomethingOnlyOfRowsThatFail) {
  const std::string text = AuditText(SampleAudit());
  EXPECT_THAT(text, Not(HasSubstr("What is to be said about good")));
  EXPECT_THAT(text, HasSubstr("  - a, b: What is to be said about a, b, in short."));
  EXPECT_THAT(text, HasSubstr("  - bad: What is to be said about bad, in short."));
}

TEST(AuditText, NamesTheBoundsLeftAfterTheChange) {
  const std::string text = WithoutWraps(AuditText(SampleAudit()));
  EXPECT_THAT(text, HasSubstr("So changed it leaves bounds-paper.json: Rs 0.0363 below 0.2."));
  EXPECT_THAT(text, HasSubstr("As printed it leaves bounds-paper.json: Rsh 153 above 100."));
}

TEST(AuditText, EndsWithASummary) {
  const std::string text = AuditText(SampleAudit());
  EXPECT_THAT(text, HasSubstr("1 row could not be audited\n"
                              "  - rows.csv:9:4: expected a number, found 'x'\n"));
  EXPECT_THAT(text, HasSubstr("3 rows: reproduces 1, reproduces if changed 1, does not reproduce "
                              "1; 1 more could not be audited.\n"));
  EXPECT_THAT(text, HasSubstr("0 with codata, 2 with literature, 0 with paper."));
}

TEST(AuditText, CountsNoConstantsWhereTheyWereStated) {
  AuditReport report = SampleAudit();
  for (AuditFinding& finding : report.findings) finding.stated.any_constants = false;
  EXPECT_THAT(AuditText(report), Not(HasSubstr("by constants")));
}

TEST(AuditText, NamesRowsWithoutAnAlgorithmByTheirLine) {
  AuditReport report = SampleAudit();
  report.findings[2].row.algorithm.clear();
  EXPECT_THAT(AuditText(report), HasSubstr("  - line 7: What"));
}

TEST(AuditText, CutsLongNamesInTablesOnly) {
  AuditReport report = SampleAudit();
  report.findings[2].row.algorithm = "a comprehensive \u00e4lgorithm [74]";
  const std::string text = AuditText(report);
  EXPECT_THAT(text, HasSubstr("  a comprehensive..  sd "));
  EXPECT_THAT(text, HasSubstr("  - a comprehensive \u00e4lgorithm [74]: "));
  report.findings[2].row.algorithm = "abcdefghijklmn\u00e4opqrst";
  EXPECT_THAT(AuditText(report), HasSubstr("  abcdefghijklmn..  sd "));
}

TEST(BriefAudit, IsOneLineARowAndTheSummary) {
  const std::string text = BriefAudit(SampleAudit());
  EXPECT_THAT(text, StartsWith("Table 1, good, sd of cell: claimed 9.8602E-04 A, 9.860219e-04 A "
                               "measured-current, 7.754000e-04 A solved-current: reproduces\n"));
  EXPECT_THAT(text, HasSubstr("solved-current: does not reproduce\nrows.csv:9:4: expected"));
  EXPECT_THAT(text, HasSubstr("3 rows: reproduces 1"));
}

}  // namespace
}  // namespace lyrefit
