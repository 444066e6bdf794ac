// Lower bounds and optima that the audit compares with claimed RMSE, and the objectives of claims.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "audit_rows_text.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/audit_evidence.h"
#include "lyrefit/study/audit_lowest.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using AuditLowestTest = AuditTest;

TEST_F(AuditLowestTest, SaysWhenNoParametersGiveTheClaim) {
  const AuditFinding finding = Find("pwp201", "1.8431e-3", kPwp);
  EXPECT_EQ(finding.verdict, AuditVerdict::kBelowProved) << finding.sentence;
  EXPECT_THAT(
      finding.sentence,
      HasSubstr("it is proved that with n from 0.5 to 4 no measured-current RMSE lies below"));
  ASSERT_TRUE(finding.lowest);
  EXPECT_NEAR(finding.lowest->lower_bound_A, 2.425074868e-3, 1e-12);
  ASSERT_TRUE(finding.temperatures);
  EXPECT_THAT(finding.temperatures->at_claim_C, IsEmpty());
  EXPECT_NEAR(finding.temperatures->best_C, 45, 0.1);
}

TEST_F(AuditLowestTest, ProvesOfTheObjectiveOfTheClaim) {
  SKIP_IF_SANITIZED();
  AuditOptions solved;
  solved.objective = Objective::kSolvedCurrent;
  const AuditFinding finding = Find("pwp201", "1.8431e-3", kPwp, ",,,", solved);
  EXPECT_EQ(finding.verdict, AuditVerdict::kBelowProved) << finding.sentence;
  EXPECT_NEAR(finding.lowest->lower_bound_A, 2.052960641e-3, 1e-11);
  EXPECT_NEAR(finding.lowest->rmse_A, 2.052960641e-3, 1e-11);
  EXPECT_THAT(
      finding.sentence,
      HasSubstr("it is proved that with n from 0.5 to 4 no solved-current RMSE lies below"));
}

TEST_F(AuditLowestTest, SaysWhereOnlyAWiderRangeOfNMeetsTheClaim) {
  SKIP_IF_SANITIZED();
  AuditOptions solved;
  solved.objective = Objective::kSolvedCurrent;
  const AuditFinding finding = Find("rtc_france", "7.182306e-4", ",,,,,,", ",,,", solved, "dd");
  EXPECT_EQ(finding.verdict, AuditVerdict::kNoParameters) << finding.sentence;
  EXPECT_NEAR(finding.lowest->reached_A, 6.981947e-4, 1e-10);
  EXPECT_LE(finding.lowest->lower_bound_A, finding.lowest->reached_A);
  EXPECT_THAT(finding.sentence,
              HasSubstr("the best fit with n from 1 to 2 has 7.326481e-04 A. With n from 0.5 to 4 "
                        "the claim can be met, down to 6.981947e-04 A."));
}

// A claim between the proved lower bound and the best known RMSE is not refuted.
TEST(AuditLowest, TellsBelowTheProvedFromBelowTheBestKnown) {
  AuditFinding finding;
  finding.row.rmse.value = 9e-4;
  finding.row.rmse.half_unit = 5e-6;
  AuditLowest lowest;
  lowest.rmse_A = 1.1e-3;
  lowest.n_lower = 1;
  lowest.n_upper = 2;
  EXPECT_EQ(LowestFound(lowest), 1.1e-3);
  EXPECT_FALSE(IsBelow(finding.row.rmse, lowest.lower_bound_A)) << "nothing is proved";
  lowest.reached_A = 1e-3;
  lowest.lower_bound_A = 8e-4;
  lowest.n_lower = 0.5;
  lowest.n_upper = 4;
  EXPECT_EQ(LowestFound(lowest), 1e-3);
  EXPECT_FALSE(IsBelow(finding.row.rmse, lowest.lower_bound_A));
  EXPECT_TRUE(IsBelow(finding.row.rmse, LowestFound(lowest)));
  finding.lowest = lowest;
  finding.verdict = AuditVerdict::kBelowKnown;
  EXPECT_THAT(AuditSentence(finding),
              HasSubstr("and none known give the claim: the least measured-current RMSE found with "
                        "n from 0.5 to 4 is 1.000000e-03 A"));
}

// A row may state the objective of its claim.
TEST_F(AuditLowestTest, TakesTheObjectiveOfTheRow) {
  const std::string header =
      "source,device,model,algorithm,objective,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_uA,n1\n";
  const std::string row = "2.13853e-3,1.0305143,1.20127101,981.98228,3.48226294,1.35119128\n";
  AuditOptions options;
  options.curve_folders = {LYREFIT_DATA_DIR};
  const auto report = Audit(
      folder_.Write("deep/rows.csv", header + "T,pwp201,sd,x,solved-current," + row +
                                         "T,pwp201,sd,x,," + row + "T,pwp201,sd,x,best," + row),
      options);
  ASSERT_TRUE(report) << report.error().ToString();
  ASSERT_THAT(report->findings, SizeIs(2));
  EXPECT_EQ(report->findings[0].verdict, AuditVerdict::kReproduces);
  EXPECT_THAT(ChangesOf(report->findings[1]), ElementsAre("as the solved-current RMSE"));
  ASSERT_THAT(report->bad_rows, SizeIs(1));
  EXPECT_THAT(report->bad_rows[0].message, HasSubstr("expected an objective"));
}

TEST_F(AuditLowestTest, TakesTheRootOfASumOfSquares) {
  const std::string header =
      "source,device,model,algorithm,sse_A2,Iph_A,Rs_ohm,Rsh_100ohm,Is1_uA,n1\n";
  AuditOptions options;
  options.curve_folders = {LYREFIT_DATA_DIR};
  const auto report = Audit(
      folder_.Write("deep/rows.csv",
                    header + "T,pwp201,sd,x,1.470247e-4,1.0305143,1.20127101,9.8198228,3.48226294,"
                             "1.35119128\n"),
      options);
  ASSERT_TRUE(report) << report.error().ToString();
  ASSERT_THAT(report->findings, SizeIs(1)) << report->bad_rows[0].ToString();
  const AuditFinding& finding = report->findings[0];
  EXPECT_EQ(finding.verdict, AuditVerdict::kReproduces) << finding.sentence;
  EXPECT_NEAR(finding.row.rmse.value, 2.425075e-3, 1e-9);
  EXPECT_NEAR(finding.row.rmse.half_unit, 4.12e-10, 1e-11);
  EXPECT_EQ(finding.row.rmse.text, "1.470247e-4");
}

// Parameters that minimise the RMSE after one Newton step from the measured current, RTC France.
TEST_F(AuditLowestTest, FindsThatTheEquationWasNotSolvedToItsEnd) {
  AuditOptions solved;
  solved.objective = Objective::kSolvedCurrent;
  const AuditFinding finding =
      Find("rtc_france", "7.7298567e-4",
           "0.76078796391,0.036546780317,52.889909051,0.31069094741,1.4772697321,,", ",,,", solved);
  EXPECT_THAT(ChangesOf(finding),
              ElementsAre("as the RMSE of one Newton step from the measured currents"));
  EXPECT_TRUE(finding.explanations[0].reading.newton_step);
  EXPECT_NEAR(finding.explanations[0].reading.figure_A, 7.729856713e-4, 1e-12);
  EXPECT_NEAR(finding.stated.rmse.solved_current_A, 7.73006e-4, 1e-8);
}

// The audit finds the minimum of the RMSE after one Newton step by itself, also for a row without
// parameters.
TEST_F(AuditLowestTest, FindsTheLeastThatOneNewtonStepComesTo) {
  SKIP_IF_SANITIZED();
  AuditOptions solved;
  solved.objective = Objective::kSolvedCurrent;
  const auto least = [&](const char* device, const char* model) {
    const AuditFinding finding = Find(device, "1e-4", ",,,,,,", ",,,", solved, model);
    return finding.lowest ? finding.lowest->newton_step_A : 0;
  };
  // From an independent computation with derivatives by differences.
  EXPECT_NEAR(least("rtc_france", "sd"), 7.729856713e-4, 1e-12);
  EXPECT_NEAR(least("pwp201", "sd"), 2.052849418e-3, 1e-12);
  EXPECT_NEAR(least("stm6_40_36", "sd"), 1.721922260e-3, 1e-12);
  EXPECT_NEAR(least("stp6_120_36", "sd"), 1.425307619e-2, 1e-11);
  EXPECT_NEAR(least("rtc_france", "dd"), 7.326299666e-4, 2e-10);  // n2 at 2, other constants
}

}  // namespace
}  // namespace lyrefit
