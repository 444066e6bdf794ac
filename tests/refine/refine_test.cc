#include "lyrefit/refine/refine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/refine/separable.h"
#include "refine/test_curves.h"

namespace lyrefit {
namespace {

constexpr Objective kBoth[] = {Objective::kMeasuredCurrent, Objective::kSolvedCurrent};

TEST(Refine, RecoversTheParametersOfACleanCurve) {
  for (const Objective objective : kBoth) {
    const RefineProblem problem =
        ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth, 0, objective);
    const RefineEnd end = Refine(problem, {3.7, 1e-7, 1.3, 0.2, 200});
    EXPECT_TRUE(end.converged);
    for (std::size_t i = 0; i < kSingleTruth.size(); ++i) {
      EXPECT_NEAR(end.p[i] / kSingleTruth[i], 1, 1e-8) << ToText(objective) << ' ' << i;
    }
  }
}

TEST(Refine, EndsWhereTheGradientVanishesOrPressesOnABound) {
  for (const Objective objective : kBoth) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode,
                                                  kDoubleTruth, 2e-3, objective, seed);
      const RefineEnd end =
          Refine(problem, SeparableDescent(problem, {3.7, 1e-8, 1.1, 0.2, 200, 1e-7, 1.8}));
      EXPECT_LE(end.projected_gradient, 1e-6);
      for (int i = 0; i < problem.device.size(); ++i) {
        EXPECT_GE(end.p[i], problem.lower[i]);
        EXPECT_LE(end.p[i], problem.upper[i]);
      }
    }
  }
}

TEST(Refine, StopsExactlyAtAnActiveBound) {
  RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth,
                                        1e-4, Objective::kSolvedCurrent);
  problem.lower[2] = 1.3;  // above the truth
  const RefineEnd end = Refine(problem, {3.7, 1e-7, 1.6, 0.2, 200});
  EXPECT_EQ(end.p[2], 1.3);
  EXPECT_TRUE(end.held[2]);
  EXPECT_LE(end.projected_gradient, 1e-7);
  RefineProblem fixed = problem;
  fixed.upper[2] = 1.3;
  EXPECT_NEAR(Refine(fixed, end.p).mean_square / end.mean_square, 1, 1e-9);
}

TEST(Refine, KeepsFixedParametersAndFitsTheRest) {
  RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth, 0,
                                        Objective::kSolvedCurrent);
  problem.lower[kRs] = problem.upper[kRs] = kSingleTruth[kRs];
  const RefineEnd end = Refine(problem, {3.7, 1e-7, 1.3, 0, 200});
  EXPECT_EQ(end.p[kRs], kSingleTruth[kRs]);
  EXPECT_NEAR(end.p[2], kSingleTruth[2], 1e-7);
}

TEST(Refine, TakesOutADiodeThatIsNotThere) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kDoubleDiode,
                                              kSingleTruth, 0, Objective::kSolvedCurrent);
  const RefineEnd end = Refine(problem, {3.8, 2e-8, 1.2, 0.25, 300, 1e-15, 1.9});
  EXPECT_EQ(end.p[5], 0);
  EXPECT_NEAR(end.p[1] / kSingleTruth[1], 1, 1e-6);
}

TEST(Refine, LetsADiodeInWhereTheResidualsAskForOne) {
  const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode,
                                              kDoubleTruth, 1e-5, Objective::kSolvedCurrent);
  // Started dead, where the gradient in its n vanishes.
  const RefineEnd end = Refine(problem, {3.8, 2e-8, 1.2, 0.25, 300, 0, 1.5});
  EXPECT_GT(end.p[5], 0);
  EXPECT_LT(std::sqrt(end.mean_square), 2e-5);
}

TEST(SeparableDescent, ComesNextToTheOptimumFromFarAway) {
  for (const Objective objective : kBoth) {
    const RefineProblem problem =
        ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode, kDoubleTruth, 1e-3, objective);
    const std::vector<double> near = SeparableDescent(problem, {1, 1e-5, 1.9, 2, 5, 1e-9, 1.1});
    const RefineEnd end = Refine(problem, near);
    EXPECT_LT(MeanSquare(problem, near) / end.mean_square, 1.001) << ToText(objective);
  }
}

TEST(SeparableStarts, AreSortedDistinctAndInsideTheBounds) {
  const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kTripleDiode,
                                              kDoubleTruth, 1e-3, Objective::kSolvedCurrent);
  const auto starts = SeparableStarts(problem, 0.3, 5);
  ASSERT_EQ(starts.size(), 5U);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    EXPECT_GE(starts[k].mean_square, starts[k > 0 ? k - 1 : 0].mean_square);
    EXPECT_EQ(starts[k].mean_square, MeanSquare(problem, starts[k].p));
    EXPECT_EQ(starts[k].origin.rfind("grid n = ", 0), 0U);
    for (int i = 0; i < problem.device.size(); ++i) {
      EXPECT_GE(starts[k].p[i], problem.lower[i]);
      EXPECT_LE(starts[k].p[i], problem.upper[i]);
    }
  }
}

}  // namespace
}  // namespace lyrefit
