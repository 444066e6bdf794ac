#include "lyrefit/refine/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/refine/sensitivity.h"
#include "lyrefit/refine/separable.h"
#include "refine/test_curves.h"

namespace lyrefit {
namespace {

TEST(FindProfileSide, EndsWhereTheRefittedSumOfSquaresReachesItsThreshold) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, kSingleTruth);
  const int degrees = 35;
  const double t = 2.03;
  const Sensitivity sensitivity = FindSensitivity(problem, best, degrees);
  for (int i = 0; i < 5; ++i) {
    for (const bool upper : {false, true}) {
      const ProfileSide side =
          FindProfileSide(problem, best, {i, upper, t, degrees, sensitivity.standard_error[i]});
      ASSERT_FALSE(side.at_bound) << i;
      EXPECT_TRUE(side.better.empty());
      EXPECT_EQ(side.value > best.p[i], upper);
      RefineProblem held = problem;
      held.lower[i] = held.upper[i] = side.value;
      const double risen = Refine(held, SeparableDescent(held, best.p)).mean_square;
      EXPECT_NEAR(std::sqrt((risen / best.mean_square - 1) * degrees), t, 0.01 * t) << i;
      // This well-measured curve is nearly linear: the symmetric interval is close.
      EXPECT_NEAR(std::fabs(side.value - best.p[i]) / (t * sensitivity.standard_error[i]), 1, 0.4)
          << i;
    }
  }
}

TEST(FindProfileSide, StopsAtTheBoundWhereTheDataDoNotObject) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kDoubleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, {3.8, 2e-8, 1.2, 0.25, 300, 1e-9, 1.6});
  const ProfileSide low = FindProfileSide(problem, best, {5, false, 2.03, 33, 0});
  EXPECT_TRUE(low.at_bound);
  EXPECT_EQ(low.value, 0);
}

TEST(FindProfileSide, EndsOutsideWhenItIsStopped) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineEnd best = Refine(problem, kSingleTruth);
  const ProfileQuery query = {kRs, true, 2.03, 35, 0};
  const ProfileSide whole = FindProfileSide(problem, best, query);
  EXPECT_TRUE(whole.settled);
  const ProfileSide stopped = FindProfileSide(problem, best, query, [] { return true; });
  EXPECT_FALSE(stopped.settled);
  EXPECT_GE(stopped.value, whole.value);
}

// Every optimum that is none, with every refit below it: the profile must reach beyond all it saw.
TEST(FindProfileSide, IsNeverNarrowerThanWhatItSaw) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  RefineEnd wrong = Refine(problem, kSingleTruth);
  wrong.mean_square *= 3;
  for (const bool upper : {false, true}) {
    const ProfileSide side = FindProfileSide(problem, wrong, {kIph, upper, 2.03, 35, 0});
    EXPECT_FALSE(side.better.empty());
    EXPECT_GT(std::fabs(side.value - wrong.p[kIph]), 1e-3);
    EXPECT_EQ(side.value > wrong.p[kIph], upper);
  }
}

TEST(FindSensitivity, IsTheScatterOfRepeatedMeasurements) {
  constexpr int kRepeats = 400;
  std::vector<double> mean(5), square(5), claimed(5);
  for (int run = 0; run < kRepeats; ++run) {
    const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                                kSingleTruth, 1e-3, Objective::kSolvedCurrent, run);
    const RefineEnd end = Refine(problem, kSingleTruth);
    const Sensitivity sensitivity = FindSensitivity(problem, end, 35);
    for (int i = 0; i < 5; ++i) {
      mean[i] += end.p[i] / kRepeats;
      square[i] += end.p[i] * end.p[i] / kRepeats;
      claimed[i] += sensitivity.standard_error[i] / kRepeats;
    }
  }
  for (int i = 0; i < 5; ++i) {
    const double scatter = std::sqrt(square[i] - mean[i] * mean[i]);
    EXPECT_NEAR(claimed[i] / scatter, 1, 0.15) << i;
    EXPECT_NEAR(mean[i], kSingleTruth[i],
                5 * scatter / std::sqrt(kRepeats) + 0.02 * kSingleTruth[i])
        << i;
  }
}

TEST(FindSensitivity, SaysNothingOfHeldParameters) {
  RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth,
                                        1e-3, Objective::kSolvedCurrent);
  problem.lower[2] = problem.upper[2] = 1.2;
  const Sensitivity sensitivity = FindSensitivity(problem, Refine(problem, kSingleTruth), 36);
  EXPECT_TRUE(std::isnan(sensitivity.standard_error[2]));
  EXPECT_GT(sensitivity.standard_error[1], 0);
}

}  // namespace
}  // namespace lyrefit
