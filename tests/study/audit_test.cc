#include "lyrefit/study/audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "audit_rows_text.h"
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

TEST_F(AuditTest, TellsTheTwoObjectivesApart) {
  EXPECT_THAT(ChangesOf(Find("pwp201", "2.13853e-3", kPwp)),
              ElementsAre("as the solved-current RMSE"));
  AuditOptions solved;
  solved.objective = Objective::kSolvedCurrent;
  EXPECT_EQ(Find("pwp201", "2.13853e-3", kPwp, ",,,", solved).verdict, AuditVerdict::kReproduces);
}

TEST_F(AuditTest, FindsResistancesPerCell) {
  const AuditFinding finding =
      Find("pwp201", "2.425075e-3", "1.0305143,0.0333686392,27.2772856,3.48226294,1.35119128,,");
  EXPECT_THAT(ChangesOf(finding), ElementsAre("with Rs and Rsh per cell (x 36)"));
  EXPECT_NEAR(finding.explanations[0].reading.parameters[kRs], 1.201271, 1e-6);
  EXPECT_THAT(finding.sentence, HasSubstr("with Rs and Rsh per cell (x 36)"));
}

TEST_F(AuditTest, FindsTheIdealityOfTheModule) {
  EXPECT_THAT(ChangesOf(Find("pwp201", "2.425075e-3",
                             "1.0305143,1.20127101,981.98228,3.48226294,48.6428860,,")),
              ElementsAre("with n of the whole module (/ 36)"));
}

TEST_F(AuditTest, FindsTheUnitOfSaturationCurrents) {
  EXPECT_THAT(ChangesOf(Find("pwp201", "2.425075e-3",
                             "1.0305143,1.20127101,981.98228,3.48226294e-6,1.35119128,,")),
              ElementsAre("with Is1 in A instead of uA"));
  EXPECT_THAT(ChangesOf(Find("pwp201", "2.425075e-3",
                             "1.0305143,1.20127101,981.98228,3.48226294e-3,1.35119128,,")),
              ElementsAre("with Is1 in mA instead of uA"));
}

TEST_F(AuditTest, FindsTheUnitOfOneDiodeAlone) {
  const AuditFinding finding = Find(
      "rtc_france", "9.82485E-04",
      "0.760781079,0.03674043,55.48544096,7.49347E-1,2,2.25974E-7,1.45101678", ",,,", {}, "dd");
  EXPECT_THAT(ChangesOf(finding), ElementsAre("with Is2 in A instead of uA"));
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

TEST_F(AuditTest, FindsTheCurveOfAnotherDevice) {
  EXPECT_THAT(Find("rtc_france", "1.729814e-3", kStm).explanations[0].reading.changes,
              ElementsAre("on the curve of stm6_40_36"));
}

TEST_F(AuditTest, FindsTwoAndThreeChangesAtOnce) {
  EXPECT_THAT(ChangesOf(Find("pwp201", "2.425075e-3",
                             "1.0305143,0.0333686392,27.2772856,3.48226294,1.35119128,,", "25,,,")),
              ElementsAre("with Rs and Rsh per cell (x 36)", "at 45 C in place of 25 C"));
  EXPECT_THAT(
      ChangesOf(Find("pwp201", "2.425075e-3",
                     "1.0305143,0.0333686392,27.2772856,3.48226294e-6,1.35119128,,", "25,,,")),
      ElementsAre("with Rs and Rsh per cell (x 36)", "with Is1 in A instead of uA",
                  "at 45 C in place of 25 C"));
}

TEST_F(AuditTest, HoldsARowToItsConstants) {
  // With n at its bound, the RMSE depends on the constants.
  constexpr char kRow[] = "0.760781079,0.03674043,55.48544096,7.49347E-1,2,2.25974E-1,1.45101678";
  const AuditFinding open = Find("rtc_france", "9.82485E-04", kRow, ",,,", {}, "dd");
  EXPECT_EQ(open.verdict, AuditVerdict::kReproduces);
  EXPECT_THAT(open.stated.constants, ElementsAre(ConstantSet::kLiterature));
  EXPECT_THAT(open.sentence, HasSubstr("with the constants literature"));
  const AuditFinding held = Find("rtc_france", "9.82485E-04", kRow, ",,paper,", {}, "dd");
  EXPECT_THAT(ChangesOf(held), ElementsAre("with the constants literature in place of paper"));
  AuditOptions options;
  options.constants = ConstantSet::kLiterature;
  EXPECT_EQ(Find("rtc_france", "9.82485E-04", kRow, ",,,", options, "dd").verdict,
            AuditVerdict::kReproduces);
}

TEST_F(AuditTest, TakesTheCellsOfTheRow) {
  const AuditFinding finding = Find(
      "pwp201", "2.425075e-3", "1.0305143,1.20127101,981.98228,3.48226294,48.642886,,", ",1,,");
  EXPECT_EQ(finding.verdict, AuditVerdict::kReproduces) << finding.sentence;
  EXPECT_EQ(finding.stated.cells, 1);
}

TEST_F(AuditTest, SaysWhenARowIsBetterThanItsClaim) {
  const AuditFinding optimum = Find("pwp201", "2.4612e-3", kPwp);
  EXPECT_EQ(optimum.verdict, AuditVerdict::kBetter) << optimum.sentence;
  EXPECT_NEAR(optimum.optimum_A, 2.425074868e-3, 1e-11);
  EXPECT_THAT(optimum.sentence, HasSubstr("that is the optimum"));
  const AuditFinding better =
      Find("pwp201", "4.0012e-3", "1.0305143,1.21127101,981.98228,3.48226294,1.35119128,,");
  EXPECT_EQ(better.verdict, AuditVerdict::kBetter) << better.sentence;
  EXPECT_THAT(better.sentence, Not(HasSubstr("that is the optimum")));
}

TEST_F(AuditTest, SaysWhenDigitsAreTooFew) {
  const AuditFinding finding = Find("pwp201", "5e-2", "1.0,1.2,980,3.5,1.4,,");
  EXPECT_EQ(finding.verdict, AuditVerdict::kTooCoarse) << finding.sentence;
  EXPECT_GT(finding.stated.tolerance_A, 0.2 * 5e-2);
}

TEST_F(AuditTest, TakesAGoodMatchOfFewDigits) {
  // Is1 has three digits, which make the RMSE uncertain by a fifth of the claim.
  const AuditFinding finding =
      Find("rtc_france", "9.8602E-04", "0.760776,0.036377,53.71852,3.2E-1,1.48,,");
  EXPECT_NE(finding.verdict, AuditVerdict::kReproduces) << finding.sentence;
  const AuditFinding good =
      Find("rtc_france", "9.8602E-04", "0.760776,0.036377,53.71852,3.23E-01,1.481184,,");
  EXPECT_EQ(good.verdict, AuditVerdict::kReproduces) << good.sentence;
  EXPECT_GT(good.stated.tolerance_A, 0.1 * 9.86e-4);
}

TEST_F(AuditTest, RecognisesARowThatOnlyLooksLikeAnotherDevice) {
  const AuditFinding known = Find("rtc_france", "9.8602E-04", "1.6639,0.1539,573.42,1.74,1.5203,,");
  EXPECT_EQ(known.verdict, AuditVerdict::kOtherDevice) << known.sentence;
  ASSERT_TRUE(known.other_device);
  EXPECT_EQ(known.other_device->curve, "stm6_40_36");
  EXPECT_LT(known.other_device->rmse.measured_current_A, 3e-3);
  const AuditFinding unknown = Find("rtc_france", "2.8214E-02", "8.2186,0.2409,130.28,1e-3,57,,");
  EXPECT_EQ(unknown.verdict, AuditVerdict::kOtherDevice) << unknown.sentence;
  EXPECT_FALSE(unknown.other_device);
  EXPECT_THAT(unknown.sentence, HasSubstr("Isc about 8.22 A"));
  EXPECT_THAT(unknown.sentence, HasSubstr("n of 57 looks like n times the cells"));
}

TEST_F(AuditTest, NamesParametersOutsideTheBounds) {
  const AuditFinding paper =
      // bounds: bounds-paper.json
      Find("rtc_france", "1e-3", "0.760776,0.036377,153.7,3.23E-1,2.5,,");
  EXPECT_EQ(paper.bounds_name, "paper");
  ASSERT_THAT(paper.stated.left_bounds, SizeIs(2));
  EXPECT_EQ(paper.stated.left_bounds[0].info.symbol, "n1");
  EXPECT_EQ(paper.stated.left_bounds[0].upper, 2);
  EXPECT_EQ(paper.stated.left_bounds[1].info.symbol, "Rsh");
  const AuditFinding literature =
      Find("rtc_france", "1e-3", "0.760776,0.6,53.7,3.23E-1,1.48,,", ",,,literature");
  EXPECT_EQ(literature.bounds_name, "literature");
  ASSERT_THAT(literature.stated.left_bounds, SizeIs(1));
  EXPECT_EQ(literature.stated.left_bounds[0].info.name, "resistance_series");
  // this curve has no file bounds-paper.json
  EXPECT_EQ(Find("pwp201", "2.425075e-3", kPwp).bounds_name, "");
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

TEST_F(AuditTest, SurvivesAbsurdNumbers) {
  for (const char* row : {"1e9,1e9,1e-300,1e9,1e-300,,", "0,0,1e9,0,1e9,,", "1,1e9,1e9,1e9,0.001,,",
                          "1,0,1,1e-300,1,,"}) {
    const AuditFinding finding = Find("pwp201", "1e-3", row);
    EXPECT_FALSE(finding.sentence.empty()) << row;
  }
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
