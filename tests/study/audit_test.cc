#include "lyrefit/study/audit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "audit_rows_text.h"
#include "cases.h"
#include "error_of.h"
#include "lyrefit/model/model_points.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST_F(AuditTest, ReproducesATrueClaim) {
  const AuditFinding finding = Find("pwp201", "2.425075e-3", kPwp);
  EXPECT_EQ(finding.verdict, AuditVerdict::kReproduces) << finding.sentence;
  EXPECT_NEAR(finding.stated.rmse.measured_current_A, 2.425075e-3, 1e-9);
  EXPECT_NEAR(finding.stated.rmse.solved_current_A, 2.138526e-3, 1e-8);
  EXPECT_THAT(finding.stated.constants, Contains(ConstantSet::kCodata));
  EXPECT_THAT(finding.explanations, IsEmpty());
  EXPECT_EQ(finding.stated.cells, 36);
  EXPECT_NEAR(finding.stated.temperature_C, 45, 1e-9);
}

class AuditClaims : public AuditTest {
 protected:
  // The finding of "[objective or constants] DEVICE,MODEL,...", a row behind its source.
  std::string Told(std::string row) {
    AuditOptions options;
    if (row[0] == '[') {
      const std::size_t end = row.find("] ");
      const std::string name = row.substr(1, end - 1);
      row = row.substr(end + 2);
      options.objective = FromText<Objective>(name).value_or(options.objective);
      if (const auto set = FromText<ConstantSet>(name)) options.constants = *set;
    }
    const AuditReport report = AuditRowsText("T," + row + "\n", options);
    if (report.findings.size() != 1) return report.bad_rows.at(0).ToString();
    const AuditFinding& finding = report.findings[0];
    std::string told = ToText(finding.verdict) + ": " + finding.sentence;
    for (const AuditExplanation& one : finding.explanations) {
      for (const std::string& change : one.reading.changes) told += "; " + change;
    }
    for (const ConstantSet set : finding.stated.constants) told += "; " + ToText(set);
    for (const LeftBound& left : finding.stated.left_bounds) {
      told += fmt::format("; {} left {} to {} of {}", left.info.symbol, left.lower, left.upper,
                          finding.bounds_name);
    }
    return told;
  }
};

TEST_F(AuditClaims, AreReproducedExplainedOrRefuted) {
  CheckCases("audit_claims", {{"claim", [this](const std::string& row) { return Told(row); }}});
}

TEST_F(AuditTest, FindsAnotherTemperatureAndItsRange) {
  const AuditFinding finding = Find("pwp201", "2.425075e-3", kPwp, "25,,,");
  EXPECT_NEAR(finding.stated.temperature_C, 25, 1e-9);
  EXPECT_THAT(ChangesOf(finding), ElementsAre("at 45 C in place of 25 C"));
  const AuditExplanation& explanation = finding.explanations[0];
  EXPECT_LT(explanation.low_temperature_C, 45);
  EXPECT_GT(explanation.low_temperature_C, 44.99);
  EXPECT_GT(explanation.high_temperature_C, 45);
  EXPECT_LT(explanation.high_temperature_C, 45.01);
}

TEST_F(AuditTest, ListsRowsItCannotAuditAndGoesOn) {
  const std::string good = std::string("T,pwp201,sd,x,2.425075e-3,") + kPwp + ",,,,\n";
  const AuditReport report =
      AuditRowsText(good + "T,nowhere,sd,x,2.425075e-3," + kPwp + ",,,,\n" + "T,pwp201,sd,x,text," +
                    kPwp + ",,,,\n" + "T,pwp201,sd,x,2.425075e-3," + kPwp + ",,,,mine\n" + good);
  EXPECT_THAT(report.findings, SizeIs(2));
  ASSERT_THAT(report.bad_rows, SizeIs(3));
  EXPECT_EQ(report.bad_rows[0].line, 3);
  EXPECT_EQ(report.bad_rows[0].column, 3);
  EXPECT_THAT(report.bad_rows[0].message, HasSubstr("no curve of device 'nowhere'"));
  EXPECT_EQ(report.bad_rows[1].line, 4);
  EXPECT_THAT(report.bad_rows[2].message, HasSubstr("no bounds 'mine'"));
  EXPECT_EQ(report.bad_rows[2].line, 5);
  EXPECT_GT(report.bad_rows[2].column, 60);
}

TEST_F(AuditTest, LooksForCurvesBesideTheRowsAndAbove) {
  const std::string curve =
      "voltage_V,current_A\n0,1\n0.3,0.98\n0.5,0.7\n0.55,0.4\n0.6,0\n0.61,-0.2\n";
  folder_.Write("deep/beside/curve.csv", curve);
  folder_.Write("above.csv", curve);
  const std::string rows = std::string(kAuditHeader) +
                           "T,beside,sd,x,1e-2,1,0.01,50,1e-3,1.1,,,25,1,,\n" +
                           "T,above,sd,x,1e-2,1,0.01,50,1e-3,1.1,,,25,1,,\n";
  const auto report = Audit(folder_.Write("deep/rows.csv", rows));
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_THAT(report->bad_rows, IsEmpty());
  ASSERT_THAT(report->findings, SizeIs(2));
  EXPECT_EQ(report->findings[0].stated.curve, "beside");
  EXPECT_EQ(report->findings[1].stated.curve, "above");
  EXPECT_EQ(report->findings[0].stated.rmse.measured_current_A,
            report->findings[1].stated.rmse.measured_current_A);
}

TEST_F(AuditTest, RefusesAFolderThatIsNotThere) {
  AuditOptions options;
  options.curve_folders = {folder_.Path("none")};
  EXPECT_THAT(
      MessageOf(Audit(folder_.Write("rows.csv", std::string(kAuditHeader) + "T\n"), options)),
      HasSubstr("expected a folder"));
}

// For arbitrary claims, hardly any explanation may be found among all that are tried.
TEST_F(AuditTest, ExplainsNothingByAccident) {
  SKIP_IF_SANITIZED();
  std::ostringstream rows;
  for (int i = 0; i < Repeats(150); ++i) {
    const double claim = std::pow(10.0, -3.6 + 0.02 * i);
    rows << "T,msx60,dd,x," << std::scientific << claim << std::defaultfloat
         << ",3.8084,0.3692,169.0471,6.1528E-4,1.9997,4.8723E-4,1.0003,,,,\n"
         << "T,rtc_france,sd,x," << std::scientific << 1.07 * claim << std::defaultfloat
         << ",0.7618,0.0361,51.3,0.3412,1.4862,,,,,,\n";
  }
  const AuditReport report = AuditRowsText(rows.str());
  ASSERT_THAT(report.findings, SizeIs(2 * Repeats(150)));
  EXPECT_LE(CountFindings(report, AuditVerdict::kReproducesChanged), 3);
}

}  // namespace
}  // namespace lyrefit
