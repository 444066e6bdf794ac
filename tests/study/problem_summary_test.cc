#include "lyrefit/study/problem_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_summary.h"

namespace lyrefit {
namespace {

TEST(SummariseProblems, LeavesPlainProblemsOut) {
  EXPECT_TRUE(SummariseProblems(SyntheticComparison({SyntheticDevice("a", "", {})})).empty());
}

TEST(SummariseProblems, CountsRunsOfAllDevices) {
  const Comparison comparison = SyntheticComparison(
      {SyntheticDevice("x 0", "x", {SyntheticAlgorithm("mlo", 10, {{3, 1, 1}, {2, 1.5, 1}}, 10)}),
       SyntheticDevice("y 0", "y", {SyntheticAlgorithm("mlo", 10, {{1, 1, 1}})}),
       SyntheticDevice("x 1", "x",
                       {SyntheticAlgorithm("mlo", 10, {{5, 1 + 0.9e-6, 1 + 1.1e-6}}, 40)})});
  const auto summaries = SummariseProblems(comparison);
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_EQ(summaries[0].name, "x");
  EXPECT_EQ(summaries[0].devices.size(), 2U);
  ASSERT_EQ(summaries[0].algorithms.size(), 1U);
  const AlgorithmSummary& mlo = summaries[0].algorithms[0];
  const LevelSummary& searched = *mlo.At(PolishLevel::kSearch);
  EXPECT_EQ(searched.runs, 3);
  EXPECT_EQ(searched.hits, 0);
  EXPECT_NEAR(searched.excess.median, 2, 1e-12) << "of 1, 2 and 4";
  EXPECT_NEAR(searched.excess.mean, 7.0 / 3, 1e-12);
  EXPECT_NEAR(searched.seconds, 10e-3, 1e-15) << "of 10, 10 and 40 ms";
  EXPECT_EQ(mlo.At(PolishLevel::kOwn)->hits, 2) << "0.9e-6 is a hit";
  EXPECT_NEAR(mlo.At(PolishLevel::kOwn)->seconds, 15e-3, 1e-15) << "the search and its polish";
  EXPECT_EQ(mlo.At(PolishLevel::kHybrid)->hits, 2) << "1.1e-6 is none";
  EXPECT_NEAR(mlo.At(PolishLevel::kHybrid)->seconds, 40e-3, 1e-15);
}

TEST(SummariseProblems, LooksAtWhatIsNoSearchAsAWhole) {
  const auto summaries = SummariseProblems(
      SyntheticComparison({SyntheticDevice("x 0", "x",
                                           {SyntheticAlgorithm("shape", 0, {{3, 2, 1}}),
                                            SyntheticAlgorithm("default", 0, {{3, 1, 1}})})}));
  for (const AlgorithmSummary& compared : summaries[0].algorithms) {
    EXPECT_FALSE(compared.At(PolishLevel::kSearch));
    EXPECT_FALSE(compared.At(PolishLevel::kOwn));
    EXPECT_EQ(compared.At(PolishLevel::kHybrid)->hits, 1);
  }
}

TEST(SummariseProblems, HasNoTimeWhereARunHasNone) {
  Comparison comparison = SyntheticComparison(
      {SyntheticDevice("x 0", "x", {SyntheticAlgorithm("mlo", 10, {{3, 2, 1}, {3, 2, 1}})})});
  comparison.problems[0].algorithms[0].runs[1].own_seconds = kUnknown;
  comparison.problems[0].algorithms[0].runs[0].plain_polished_A = kUnknown;
  const auto summaries = SummariseProblems(comparison);
  EXPECT_TRUE(std::isnan(summaries[0].algorithms[0].At(PolishLevel::kOwn)->seconds));
  EXPECT_FALSE(summaries[0].algorithms[0].At(PolishLevel::kPlain))
      << "not every run was taken there";
}

// Five runs on one device and two on another. The first device has wrong local optima at 1.5 (two
// runs, equal to 1e-7) and at 3. The second has one at 1.5, which counts separately.
TEST(Failures, AreGroupedByWhereTheyEndedOnTheirDevice) {
  const double near = 1.5 * (1 + 1e-7);
  Comparison comparison = SyntheticComparison(
      {SyntheticDevice(
           "x 0", "x",
           {SyntheticAlgorithm("mlo", 10,
                               {{9, 1.5, 1}, {9, 1, 1}, {9, 3, 1}, {9, near, 1}, {9, 1, 1}})}),
       SyntheticDevice("x 1", "x", {SyntheticAlgorithm("mlo", 10, {{9, 1.5, 1}, {9, 1, 1}})})});
  comparison.problems[0].parameters = comparison.problems[1].parameters = {"Rs", "d1", "d2"};
  for (ProblemResult& device : comparison.problems) {
    device.first_effect = 1;
    device.reference.parameters = {1, 0.5, 0.8};
    for (RunRecord& run : device.algorithms[0].runs) run.own_parameters = {7, 0.5, 0.6};
  }
  comparison.problems[0].algorithms[0].runs[2].own_parameters = {7, 1.5, 0.8};
  const auto summaries = SummariseProblems(comparison);
  const Failures& failures = summaries[0].algorithms[0].At(PolishLevel::kOwn)->failures;
  EXPECT_EQ(failures.runs, 4);
  EXPECT_EQ(failures.local_optima, 3);
  EXPECT_EQ(failures.commonest, 2);
  EXPECT_EQ(failures.commonest_device, "x 0");
  EXPECT_NEAR(failures.commonest_excess, 0.5, 1e-12);
  EXPECT_NEAR(failures.median_excess, 0.5, 1e-6);
  EXPECT_NEAR(failures.worst_excess, 2, 1e-12);
  EXPECT_NEAR(failures.median_deviation, 0.25, 1e-12) << "of d2: 0.25 three times, of d1: 2";
  EXPECT_NEAR(failures.worst_deviation, 2, 1e-12);
  EXPECT_EQ(failures.worst_parameter, "d1");
  EXPECT_EQ(summaries[0].algorithms[0].At(PolishLevel::kHybrid)->failures.runs, 0);
  EXPECT_TRUE(
      std::isnan(summaries[0].algorithms[0].At(PolishLevel::kSearch)->failures.worst_deviation));
}

TEST(LargestDeviation, IsRelativeToTheReferenceAndOfTheEffectsAlone) {
  ProblemResult device = SyntheticDevice("x 0", "x", {});
  device.parameters = {"Rs", "d1", "d2", "d3"};
  device.reference.parameters = {1, -2, 0, 0};
  EXPECT_EQ(LargestDeviation(device, {4, -2, 0, 0}).value, 3) << "a device without effects";
  device.first_effect = 1;
  EXPECT_EQ(LargestDeviation(device, {4, -2, 0, 0}).value, 0);
  EXPECT_EQ(LargestDeviation(device, {4, -3, 0, 0}).value, 0.5);
  EXPECT_EQ(LargestDeviation(device, {4, -3, 0, 0.1}).value, 1) << "from nothing to something";
  EXPECT_EQ(LargestDeviation(device, {4, -3, 0, 0.1}).parameter, 3);
  EXPECT_EQ(LargestDeviation(device, {}).parameter, -1) << "not kept";
}

}  // namespace
}  // namespace lyrefit
