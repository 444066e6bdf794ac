#include "paper/proof_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_app.h"
#include "error_of.h"
#include "paper/proof_blocks.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ForeignProofs, AreThoseOfTheLastRunThatLookedAtAnything) {
  const auto proofs = ReadForeignProofs(DataFolder("published") + "/proofs.csv");
  ASSERT_TRUE(proofs) << proofs.error().ToString();
  ASSERT_EQ(proofs->size(), 4U);
  EXPECT_EQ((*proofs)[0].curve, "rtc_france");
  EXPECT_NEAR((*proofs)[0].lower_bound_A2, 2.51783799567e-05, 1e-16);
  EXPECT_NEAR((*proofs)[0].seconds, 13547.4, 0.1);
  EXPECT_EQ((*proofs)[1].lower_bound_A2, 0);
  EXPECT_NEAR((*proofs)[1].best_A2, 2.51532659603e-05, 1e-16);
  EXPECT_EQ((*proofs)[2].model, Model::kSingleDiode);
  EXPECT_NEAR((*proofs)[2].lower_bound_A2, 0.000146878034805, 1e-15);
  EXPECT_NEAR((*proofs)[3].seconds, 43200, 0.1);
}

TEST(ForeignProofs, RefuseWhatIsNoNumber) {
  const TempFolder folder;
  const std::string file = folder.Write(
      "proofs.csv", "curve,model,best_A2,lower_bound_A2,seconds,cells\na,sd,x,0,1,1\n");
  EXPECT_THAT(MessageOf(ReadForeignProofs(file)), HasSubstr("expected a number, found 'x'"));
}

ProofRow RowOf(Model model, Objective objective, double rmse_A, double gap) {
  ProofRow row = {"rtc_france", 26, "literature", {}, {}};
  row.options.objective = objective;
  row.proof.model = model;
  row.proof.rmse_A = rmse_A;
  row.proof.lower_bound_A = rmse_A * (1 - gap);
  row.proof.gap = gap;
  row.proof.certified = gap <= kCertifiedGap;
  row.seconds = 0.123;
  row.rigorous_lower_A = row.proof.lower_bound_A;
  row.rigorous_seconds = 1.5;
  return row;
}

TEST(ProofBlocks, ShowOpenGapsAndOthersProofsWhereTheyBelong) {
  ProofTable proofs;
  proofs.foreign = {{"rtc_france", Model::kSingleDiode, 26e-6, 26e-6 * 0.81, 1000}};
  proofs.rows = {RowOf(Model::kSingleDiode, Objective::kMeasuredCurrent, 1e-3, 5e-11),
                 RowOf(Model::kSingleDiode, Objective::kSolvedCurrent, 2e-3, 0.25)};
  const std::string page = WithProofs(
      "a\n<!-- proofs -->\n<!-- end of proofs -->\n<!-- proofs-short -->\nstale\n<!-- end of "
      "proofs-short -->\nb\n",
      proofs);
  EXPECT_THAT(page, HasSubstr("measured-current: 1 of 1 certified; solved-current: 0 of 1"));
  EXPECT_THAT(page,
              HasSubstr("| rtc_france | literature | sd | 1.000000000e-03 | 9.999999999e-04 | "
                        "5.0e-11 | 0.12 | 9.999999999e-04 | 1.5 | 1.000000e-03, gap 1.0e-01 "
                        "in 1000 s |"));
  EXPECT_THAT(page, HasSubstr("| **2.5e-01** | 0.12 |"));
  EXPECT_THAT(page, HasSubstr("| 2.000000000e-03 | **2.5e-01**, 0.12 | 1.0e-01, 1000 |"));
  EXPECT_THAT(page, Not(HasSubstr("stale")));
}

// With little effort gaps stay open, but no bound exceeds the reached RMSE and every box has its
// rows.
TEST(ProofTable, HasEveryShippedCurveInEveryBox) {
  SKIP_IF_SANITIZED();
  const auto proofs = ProveShipped(LYREFIT_DATA_DIR, 10, 0);
  ASSERT_TRUE(proofs) << proofs.error().ToString();
  EXPECT_EQ(proofs->rows.size(), 66U);
  int literature = 0;
  for (const ProofRow& row : proofs->rows) {
    SCOPED_TRACE(row.curve + " " + row.box + " " + ToText(row.proof.model));
    literature += row.box == "literature" ? 1 : 0;
    EXPECT_GT(row.proof.rmse_A, 0);
    EXPECT_LE(row.proof.lower_bound_A, row.proof.rmse_A);
    EXPECT_LE(row.rigorous_lower_A, row.proof.rmse_A);
  }
  EXPECT_EQ(literature, 24);
}

}  // namespace
}  // namespace lyrefit
