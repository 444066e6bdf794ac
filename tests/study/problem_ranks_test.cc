#include "lyrefit/study/problem_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "synthetic_summary.h"

namespace lyrefit {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

// Two problems, with two devices and one device, one run each. By the search alone, mlo ends below
// de in all three blocks; after the polish they are equal in two blocks.
Comparison ThreeBlocks() {
  const auto device = [](const char* name, const char* problem, double de_own) {
    return SyntheticDevice(
        name, problem,
        {SyntheticAlgorithm("shape", 0, {{9, 9, 1}}), SyntheticAlgorithm("mlo", 10, {{2, 1, 1}}),
         SyntheticAlgorithm("de", 10, {{3, de_own, 1}}),
         SyntheticAlgorithm("mlo", 100, {{2, 1, 1}})});
  };
  return SyntheticComparison(
      {device("x 0", "x", 1 + 0.9e-6), device("x 1", "x", 1.5), device("y 0", "y", 1)});
}

TEST(RankProblems, RanksAllProblemsTogetherThenEach) {
  const Comparison comparison = ThreeBlocks();
  const auto rankings = RankProblems(SummariseProblems(comparison));
  ASSERT_EQ(rankings.size(), 2U) << "y has one block, and 100 evaluations one search";
  EXPECT_EQ(rankings[0].problem, "");
  EXPECT_EQ(rankings[0].budget, 10);
  EXPECT_THAT(rankings[0].names, ElementsAre("mlo", "de"));
  EXPECT_EQ(rankings[0].searched.friedman.blocks, 3);
  EXPECT_THAT(rankings[0].searched.friedman.mean_rank, ElementsAre(1, 2));
  EXPECT_DOUBLE_EQ(rankings[0].searched.friedman.chi_square, 3) << "b (k - 1) where all agree";
  EXPECT_EQ(rankings[1].problem, "x");
  EXPECT_EQ(rankings[1].searched.friedman.blocks, 2);
}

TEST(RankProblems, TakesEndsOfABlockWithin1e6AsEqual) {
  const Comparison comparison = ThreeBlocks();
  const auto rankings = RankProblems(SummariseProblems(comparison));
  // Mean rank of mlo: (1.5 + 1.5 + 1) / 3 = 4 / 3.
  EXPECT_THAT(rankings[0].own.friedman.mean_rank,
              ElementsAre(DoubleEq(4.0 / 3), DoubleEq(5.0 / 3)));
  EXPECT_EQ(rankings[0].own.signed_ranks[0].test.pairs, 1);
  EXPECT_EQ(rankings[0].own.signed_ranks[0].test.zeros, 2);
}

TEST(RankProblems, LeavesOutBlocksThatNotAllHaveDone) {
  Comparison comparison = ThreeBlocks();
  comparison.problems[1].algorithms.erase(comparison.problems[1].algorithms.begin() + 2);
  const auto rankings = RankProblems(SummariseProblems(comparison));
  ASSERT_EQ(rankings.size(), 1U);
  EXPECT_EQ(rankings[0].searched.friedman.blocks, 2);
}

}  // namespace
}  // namespace lyrefit
