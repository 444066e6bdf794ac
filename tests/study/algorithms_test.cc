#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/study/algorithms.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> Names(const std::vector<ComparedAlgorithm>& algorithms) {
  std::vector<std::string> names;
  for (const ComparedAlgorithm& compared : algorithms) names.push_back(compared.name);
  return names;
}

TEST(PlainAlgorithms, TakeTheSettingsOfTheSearch) {
  SearchOptions search;
  search.population = 33;
  search.memory_rate = 0.75;
  const auto algorithms = PlainAlgorithms({Algorithm::kLoMblss, Algorithm::kDe}, search);
  EXPECT_THAT(Names(algorithms), ElementsAre("lo+mblss", "de"));
  EXPECT_EQ(algorithms[0].search.algorithm, Algorithm::kLoMblss);
  EXPECT_EQ(algorithms[0].search.memory_rate, 0.75);
  EXPECT_EQ(algorithms[1].search.algorithm, Algorithm::kDe);
  EXPECT_EQ(algorithms[1].search.population, 33);
  EXPECT_EQ(algorithms[1].algorithm, "de");
}

TEST(BudgetAlgorithms, HaveTheAlgorithmInTheOuterLoop) {
  const auto algorithms = BudgetAlgorithms({Algorithm::kMlo, Algorithm::kRandom}, {10, 420});
  EXPECT_THAT(Names(algorithms), ElementsAre("mlo@10", "mlo@420", "random@10", "random@420"));
  EXPECT_EQ(algorithms[3].algorithm, "random");
  EXPECT_EQ(algorithms[3].search.algorithm, Algorithm::kRandom);
}

TEST(BudgetSearch, SpendsTheBudgetToTheLastEvaluation) {
  for (const std::int64_t budget : {4, 10, 17, 100, 420, 1000, 9999, 100000, 5000000}) {
    const SearchOptions search = BudgetSearch(budget);
    EXPECT_TRUE(ValidateOptions(search, kSearchOptionTable)) << budget;
    EXPECT_EQ(search.max_evaluations, budget);
    const std::int64_t planned =
        static_cast<std::int64_t>(search.population) * (search.iterations + 1);
    EXPECT_GE(planned, budget);
    if (budget >= 8) {
      EXPECT_LT(planned - search.population, budget);
    }
  }
}

TEST(BudgetSearch, ScalesThePopulationWithTheRootOfTheBudget) {
  EXPECT_EQ(BudgetSearch(10).population, 4);
  EXPECT_EQ(BudgetSearch(400).population, 20);
  EXPECT_EQ(BudgetSearch(1000000).population, 100);
}

}  // namespace
}  // namespace lyrefit
