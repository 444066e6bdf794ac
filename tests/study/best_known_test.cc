#include "lyrefit/study/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../repeats.h"
#include "lyrefit/study/compare_run.h"
#include "studies/landscape.h"
#include "summary_study.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(FindBestKnown, FindsNothingWhereNoneIsAskedFor) {
  const CompareCurve subject = SyntheticSubjects("strings_2", 1)[0];
  const CompareOptions options;
  const BestKnown known =
      FindBestKnown(subject, DescribeProblem(subject, Model::kSingleDiode, options), options);
  EXPECT_EQ(known.best.rmse_A, kInfinity);
  EXPECT_EQ(known.points, 0);
}

TEST(FindBestKnown, IsAtMostAsHighAsTheTruth) {
  SKIP_IF_SANITIZED();
  const auto cases = MakeLandscape("strings_2", 2, 0);
  ASSERT_TRUE(cases);
  CompareOptions options;
  options.multistart = 6;
  for (std::size_t d = 0; d < cases->size(); ++d) {
    const CompareCurve subject = SyntheticSubjects("strings_2", 2)[d];
    const ProblemResult problem = DescribeProblem(subject, Model::kSingleDiode, options);
    const BestKnown known = FindBestKnown(subject, problem, options);
    EXPECT_EQ(known.points, 6);
    EXPECT_LE(known.visits, 6);
    // A fit follows the noise, so that its RMSE lies below the noise of the device.
    EXPECT_LT(known.best.rmse_A, 1.2 * (*cases)[d].noise_A);
    EXPECT_EQ(known.best.parameters.size(), problem.parameters.size());
    EXPECT_FALSE(known.found_by.empty());
    const BestKnown again = FindBestKnown(subject, problem, options);
    EXPECT_EQ(again.best.rmse_A, known.best.rmse_A);
    EXPECT_EQ(again.found_by, known.found_by);
  }
}

TEST(FindBestKnown, StopsAsTheObserverAsks) {
  const CompareCurve subject = SyntheticSubjects("strings_2", 1)[0];
  CompareOptions options;
  options.multistart = 1000;
  const auto stop = [](const Progress&) { return ObserverAction::kStop; };
  const BestKnown known =
      FindBestKnown(subject, DescribeProblem(subject, Model::kSingleDiode, options), options, stop);
  EXPECT_TRUE(known.interrupted);
  EXPECT_LE(known.points, 1);
}

TEST(BestKnownReference, SaysWhatFoundIt) {
  BestKnown known;
  known.best = {1e-3, {1, 2}};
  known.found_by = "random point 17";
  known.points = 100;
  known.visits = 12;
  const Reference lower = BestKnownReference({2e-3, {3, 4}}, known);
  EXPECT_EQ(lower.rmse_A, 1e-3);
  EXPECT_EQ(lower.parameters[0], 1);
  EXPECT_TRUE(lower.by_multistart);
  EXPECT_EQ(lower.visits, 12);
  EXPECT_THAT(lower.origin, HasSubstr("found by its random point 17, where 12 of 100 random"));
  const Reference level = BestKnownReference({1e-3 * (1 - 1e-7), {3, 4}}, known);
  EXPECT_FALSE(level.by_multistart);
  EXPECT_EQ(level.parameters[0], 3);
  EXPECT_THAT(level.origin, HasSubstr("found by a run, where 12 of 100"));
  const Reference rounded = BestKnownReference({1e-3 * (1 + 1e-9), {3, 4}}, known);
  EXPECT_EQ(rounded.rmse_A, 1e-3);
  EXPECT_FALSE(rounded.by_multistart) << "a run was there as well";
  const Reference higher = BestKnownReference({5e-4, {3, 4}}, known);
  EXPECT_EQ(higher.visits, 0) << "its points ended elsewhere";
  EXPECT_EQ(BestKnownReference({5e-4, {3, 4}}, {}).origin, "best of all runs");
}

}  // namespace
}  // namespace lyrefit
