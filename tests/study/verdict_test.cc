#include "lyrefit/study/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_summary.h"

namespace lyrefit {
namespace {

// Ten runs: `own` of them hit after the polish of the best candidate, `hybrid` of them with all
// starts.
AlgorithmResult Hits(const std::string& algorithm, std::int64_t budget, int own, int hybrid,
                     double search_ms = 10) {
  std::vector<SyntheticRun> runs;
  for (int r = 0; r < 10; ++r) runs.push_back({9, r < own ? 1.0 : 2, r < hybrid ? 1.0 : 2});
  return SyntheticAlgorithm(algorithm, budget, runs, search_ms);
}

Comparison OfOne(std::vector<AlgorithmResult> algorithms) {
  return SyntheticComparison({SyntheticDevice("x 0", "x", std::move(algorithms))});
}

TEST(EnoughHits, AreNinetySixOfAHundred) {
  EXPECT_EQ(EnoughHits(50), 48);
  EXPECT_EQ(EnoughHits(100), 96);
  EXPECT_EQ(EnoughHits(10), 10);
  EXPECT_EQ(EnoughHits(2), 2);
  EXPECT_EQ(EnoughHits(25), 24);
}

TEST(JudgeProblem, TakesTheFastestWayThatIsEnough) {
  const Comparison comparison = OfOne({Hits("mlo", 10, 3, 10), Hits("mlo", 100, 10, 10, 100),
                                       Hits("de", 10, 9, 9), Hits("de", 100, 10, 10, 20)});
  const auto summaries = SummariseProblems(comparison);
  const SearchVerdict verdict = JudgeProblem(summaries[0]);
  ASSERT_TRUE(verdict.search);
  EXPECT_EQ(verdict.search->algorithm->name, "de@100") << "25 ms; mlo@10 with all starts 40 ms";
  EXPECT_EQ(verdict.search->level, PolishLevel::kOwn);
  EXPECT_EQ(verdict.needed, 10);
  EXPECT_FALSE(verdict.random);
  EXPECT_FALSE(verdict.best);
  EXPECT_FALSE(verdict.shape);
}

TEST(JudgeProblem, CountsABudgetOnlyIfAllLargerOnesAreEnough) {
  const Comparison comparison =
      OfOne({Hits("mlo", 10, 10, 0), Hits("mlo", 100, 9, 0, 100), Hits("mlo", 1000, 10, 0, 1000)});
  const auto summaries = SummariseProblems(comparison);
  EXPECT_EQ(JudgeProblem(summaries[0]).search->algorithm->name, "mlo@1000");
}

TEST(JudgeProblem, LeavesAllStartsOutWhereTheShapeIsEnough) {
  const Comparison with = OfOne({Hits("shape", 0, 0, 10, 0), Hits("mlo", 10, 3, 10)});
  const auto summaries = SummariseProblems(with);
  const SearchVerdict verdict = JudgeProblem(summaries[0]);
  EXPECT_TRUE(verdict.shape_is_enough);
  EXPECT_TRUE(verdict.shape_wins);
  EXPECT_FALSE(verdict.search) << "it gets there by the shape's starts alone";
  EXPECT_EQ(verdict.best->figures().hits, 3);
  const Comparison without = OfOne({Hits("shape", 0, 0, 9, 0), Hits("mlo", 10, 3, 10)});
  const auto other = SummariseProblems(without);
  EXPECT_EQ(JudgeProblem(other[0]).search->level, PolishLevel::kHybrid);
  EXPECT_FALSE(JudgeProblem(other[0]).shape_wins);
}

TEST(JudgeProblem, LetsAFasterSearchWinAgainstTheShape) {
  const Comparison comparison = OfOne({Hits("shape", 0, 0, 10, 0), Hits("mlo", 10, 10, 10)});
  const auto summaries = SummariseProblems(comparison);
  EXPECT_FALSE(JudgeProblem(summaries[0]).shape_wins) << "15 ms against 30 ms";
}

TEST(JudgeProblem, SetsRandomPointsBesideTheWinner) {
  const Comparison comparison =
      OfOne({Hits("mlo", 10, 10, 10), Hits("random", 10, 5, 10), Hits("random", 100, 7, 7)});
  const auto summaries = SummariseProblems(comparison);
  const SearchVerdict verdict = JudgeProblem(summaries[0]);
  EXPECT_EQ(verdict.search->algorithm->name, "mlo@10");
  ASSERT_TRUE(verdict.random);
  EXPECT_EQ(verdict.random->algorithm->name, "random@10") << "most hits, though not enough on";
  EXPECT_EQ(verdict.random->level, PolishLevel::kHybrid);
}

// A run of a peer takes its search and 5 ms; a run of the default fit takes 30 ms.
TEST(CompareWithPeers, TakesThePeerThatIsSureTheSoonest) {
  const Comparison comparison =
      OfOne({Hits("default", 0, 0, 10, 0), Hits("pagmo:cmaes", 10, 2, 10, 1),
             Hits("pagmo:cmaes", 100, 10, 10, 115), Hits("pagmo:de", 100, 10, 10, 55),
             Hits("de", 10, 10, 10, 1)});
  const auto summaries = SummariseProblems(comparison);
  const auto ratio = CompareWithPeers(summaries[0]);
  ASSERT_TRUE(ratio);
  EXPECT_EQ(ratio->peer->algorithm->name, "pagmo:de@100") << "60 ms; 6 ms 15 times are 90 ms";
  EXPECT_EQ(ratio->repeats, 1);
  EXPECT_DOUBLE_EQ(ratio->times, 2);
}

TEST(CompareWithPeers, RepeatsWhatHitsLessOften) {
  const Comparison comparison = OfOne(
      {Hits("default", 0, 0, 10, 0), Hits("pagmo:de", 10, 8, 10), Hits("pagmo:de", 100, 7, 10)});
  const auto summaries = SummariseProblems(comparison);
  const auto ratio = CompareWithPeers(summaries[0]);
  EXPECT_EQ(ratio->peer->algorithm->name, "pagmo:de@10");
  EXPECT_EQ(ratio->repeats, 2) << "0.2^2 = 0.04";
  EXPECT_DOUBLE_EQ(ratio->times, 1) << "15 ms twice by 30 ms";
  const Comparison never = OfOne({Hits("default", 0, 0, 10, 0), Hits("pagmo:de", 10, 0, 10)});
  const auto nobody = SummariseProblems(never);
  EXPECT_EQ(CompareWithPeers(nobody[0])->repeats, 0);
  EXPECT_TRUE(std::isnan(CompareWithPeers(nobody[0])->times));
  const Comparison none = OfOne({Hits("pagmo:de", 10, 8, 10)});
  const auto others = SummariseProblems(none);
  EXPECT_FALSE(CompareWithPeers(others[0]));
}

}  // namespace
}  // namespace lyrefit
