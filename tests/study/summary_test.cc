#include "lyrefit/study/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

TEST(SpreadOf, AgreesWithFiguresWorkedOutByHand) {
  const RunSpread spread = SpreadOf({4, 1, 2, 9}, 1);
  EXPECT_EQ(spread.min, 1);
  EXPECT_EQ(spread.mean, 4);
  EXPECT_EQ(spread.median, 3);
  EXPECT_EQ(spread.max, 9);
  EXPECT_DOUBLE_EQ(spread.std, std::sqrt(38.0 / 3));  // 0 + 9 + 4 + 25
  EXPECT_EQ(SpreadOf({5, 1, 3}, 1).median, 3);
}

TEST(SpreadOf, CountsRunsNearTheReference) {
  const RunSpread spread = SpreadOf({1, 1 + 0.9e-9, 1 + 1.1e-9, 1 + 0.9e-6, 1 + 1.1e-6, 2}, 1);
  EXPECT_EQ(spread.within_1e9, 2);
  EXPECT_EQ(spread.within_1e6, 4);
}

TEST(SpreadOf, HasNoStdForOneRunAndNothingForUnknownOnes) {
  EXPECT_EQ(SpreadOf({7}, 1).std, 0);
  EXPECT_EQ(SpreadOf({7}, 1).median, 7);
  const RunSpread unknown = SpreadOf({1, kUnknown}, 1);
  EXPECT_TRUE(std::isnan(unknown.min));
  EXPECT_TRUE(std::isnan(unknown.std));
  EXPECT_EQ(unknown.within_1e9, 0);
}

TEST(SpreadOf, KeepsTheMeanOfEqualValuesBetweenThem) {
  const double x = 9.824848761e-4;
  const RunSpread spread = SpreadOf(std::vector<double>(49, x), x);
  EXPECT_EQ(spread.mean, x);
  EXPECT_EQ(spread.std, 0);
}

TEST(KeepGains, DropsWhatBringsNothingButTheEnd) {
  const auto gains = KeepGains({{0, 10, 5}, {1, 20, 5}, {2, 30, 3}, {3, 40, 3}, {4, 50, 3}});
  ASSERT_EQ(gains.size(), 3U);
  EXPECT_EQ(gains[0].evaluations, 10);
  EXPECT_EQ(gains[1].evaluations, 30);
  EXPECT_EQ(gains[2].evaluations, 50);
  EXPECT_TRUE(KeepGains({}).empty());
}

TEST(EvaluationsTo, FindsTheFirstPointAtOrBelowTheTarget) {
  const std::vector<TracePoint> gains = {{0, 10, 5}, {2, 30, 3}, {4, 50, 2}};
  EXPECT_EQ(EvaluationsTo(3, gains), 30);
  EXPECT_EQ(EvaluationsTo(9, gains), 10);
  EXPECT_EQ(EvaluationsTo(1, gains), -1);
}

RunOutcome Outcome(std::vector<TracePoint> gains) {
  RunOutcome outcome;
  outcome.record.evaluations = gains.back().evaluations;
  outcome.record.searched_A = gains.back().best;
  outcome.gains = std::move(gains);
  return outcome;
}

TEST(MedianCourse, IsTheMedianOfTheBestSoFar) {
  const auto course =
      MedianCourse({Outcome({{0, 1, 8}, {1, 10, 4}, {2, 100, 1}}),
                    Outcome({{0, 1, 6}, {2, 100, 2}}), Outcome({{0, 1, 9}, {1, 50, 3}})},
                   3);
  ASSERT_EQ(course.size(), 3U);
  EXPECT_EQ(course[0].evaluations, 1);
  EXPECT_EQ(course[0].best_A, 8);
  EXPECT_EQ(course[1].evaluations, 10);
  EXPECT_EQ(course[1].best_A, 6);
  EXPECT_EQ(course[2].evaluations, 100);
  EXPECT_EQ(course[2].best_A, 2);
}

TEST(MedianCourse, HasRisingMarksWhereEvaluationsAreFew) {
  const auto course = MedianCourse({Outcome({{0, 4, 8}, {1, 9, 4}})});
  EXPECT_EQ(course.front().evaluations, 4);
  EXPECT_EQ(course.back().evaluations, 9);
  for (std::size_t i = 1; i < course.size(); ++i) {
    EXPECT_GT(course[i].evaluations, course[i - 1].evaluations);
  }
}

TEST(MedianCourse, IsOnePointForASearchOfOneStep) {
  EXPECT_EQ(MedianCourse({Outcome({{0, 1, 8}})}).size(), 1U);
}

TEST(Summarise, CountsExpectedEvaluationsAsCocoDoes) {
  std::vector<RunOutcome> outcomes = {Outcome({{0, 10, 5}, {1, 40, 1.0005}, {2, 100, 1}}),
                                      Outcome({{0, 10, 5}, {2, 100, 3}}),
                                      Outcome({{0, 10, 1}, {2, 100, 1}})};
  const AlgorithmResult result = Summarise({"x", "", {}, {}}, &outcomes, 1, 1e-3);
  EXPECT_EQ(result.algorithm, "x");
  EXPECT_EQ(result.target_hits, 2);
  EXPECT_EQ(result.runs[0].evaluations_to_target, 40);
  EXPECT_EQ(result.runs[1].evaluations_to_target, -1);
  EXPECT_DOUBLE_EQ(result.expected_evaluations, (40 + 100 + 10) / 2.0);
  EXPECT_EQ(result.evaluations, 100);
}

TEST(Summarise, ExpectsNothingWithoutAHit) {
  std::vector<RunOutcome> outcomes = {Outcome({{0, 10, 5}})};
  EXPECT_TRUE(std::isnan(Summarise({"x", "", {}, {}}, &outcomes, 1, 1e-3).expected_evaluations));
}

TEST(RankAll, RanksTheSmallestFirst) {
  const Ranking ranking = RankAll({{3, 3, 3}, {1, 1, 1}, {2, 2, kInfinity}});
  EXPECT_THAT(ranking.friedman.mean_rank,
              ElementsAre(DoubleEq(8.0 / 3), DoubleEq(1), DoubleEq(7.0 / 3)));
  EXPECT_EQ(ranking.pairs.size(), 3U);
  ASSERT_EQ(ranking.signed_ranks.size(), 3U);
  EXPECT_EQ(ranking.signed_ranks[2].first, 1);
  EXPECT_EQ(ranking.signed_ranks[2].second, 2);
  EXPECT_GE(ranking.signed_ranks[2].p_holm, ranking.signed_ranks[2].test.p_value);
}

TEST(RankJoined, TakesAnswersWithin1e9AsEqualAcrossAlgorithms) {
  const double x = 1e-3;
  const Ranking ranking = RankJoined({{x, x * (1 + 3e-10)}, {x * (1 + 6e-10), x}});
  EXPECT_THAT(ranking.friedman.mean_rank, ElementsAre(DoubleEq(1.5), DoubleEq(1.5)));
  EXPECT_EQ(ranking.signed_ranks[0].test.pairs, 0);
  const Ranking apart = RankJoined({{x, x}, {x * (1 + 1e-6), x * (1 + 1e-6)}});
  EXPECT_THAT(apart.friedman.mean_rank, ElementsAre(DoubleEq(1), DoubleEq(2)));
}

TEST(RankAll, SaysNothingOfOneAlgorithmOrOneRun) {
  EXPECT_TRUE(RankAll({{1, 2, 3}}).signed_ranks.empty());
  EXPECT_TRUE(RankAll({{1}, {2}}).signed_ranks.empty());
}

}  // namespace
}  // namespace lyrefit
