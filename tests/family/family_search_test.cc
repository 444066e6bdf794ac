#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_of.h"
#include "family/family_fixture.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

class FamilySearchTest : public FamilyFixture {
 protected:
  FamilySearchTest() : FamilyFixture(/*points=*/30, /*noise_A=*/1e-3) {}
};

TEST_F(FamilySearchTest, TakesASearchOfTheUsersOwnAndFollowsItsCandidateAlone) {
  const FamilyReport usual = Fit();
  EXPECT_TRUE(std::isnan(usual.rmse.refined_best_candidate.solved_current_A)) << "not asked for";
  int asked = 0;
  options_.searcher = [&](const ObjectiveFunction& objective, const Box& box, const SearchOptions&,
                          const Observer&) {
    ++asked;
    SearchSummary summary;
    for (std::size_t j = 0; j < box.lower.size(); ++j) {
      summary.best.x.push_back(0.5 * (box.lower[j] + box.upper[j]));
    }
    summary.best.objective = objective(summary.best.x.data());
    return summary;
  };
  options_.plain_polish = true;
  const FamilyReport report = Fit();
  EXPECT_EQ(asked, 1);
  const double searched = report.searched_all.solved_current_A;
  EXPECT_LE(report.rmse.plain_polished.solved_current_A, searched);
  EXPECT_LE(report.rmse.refined_best_candidate.solved_current_A, searched);
  EXPECT_EQ(report.refined_best_candidate.size(), report.refined.size());
  EXPECT_GE(report.refine.best_candidate_seconds, 0);
  EXPECT_NEAR(report.rmse.refined.solved_current_A / usual.rmse.refined.solved_current_A, 1, 1e-6);
  options_.starts = StartsFrom::kSearch;
  const FamilyReport alone = Fit();
  EXPECT_NEAR(
      alone.rmse.refined.solved_current_A / alone.rmse.refined_best_candidate.solved_current_A, 1,
      1e-9)
      << "the joint fit from that candidate alone";
  options_.starts = StartsFrom::kShape;
  EXPECT_NEAR(Fit().rmse.refined.solved_current_A / usual.rmse.refined.solved_current_A, 1, 1e-6);
}

TEST_F(FamilySearchTest, RefusesASearchThatLeavesItsBox) {
  options_.searcher = [](const ObjectiveFunction&, const Box& box, const SearchOptions&,
                         const Observer&) {
    SearchSummary summary;
    summary.best.x.assign(box.lower.size(), 1e300);
    return summary;
  };
  EXPECT_THAT(MessageOf(FitFamily(set_, options_)),
              HasSubstr("the searcher's best candidate is 1e+300"));
}

}  // namespace
}  // namespace lyrefit
