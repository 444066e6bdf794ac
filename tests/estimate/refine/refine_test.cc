#include "lyrefit/estimate/refine/refine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/refine/test_curves.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/model/kernel.h"

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
                                                  kTwoDiodeTruth, 2e-3, objective, seed);
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
  EXPECT_TRUE(end.active[2]);
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
                                              kTwoDiodeTruth, 1e-5, Objective::kSolvedCurrent);
  // The second diode starts at Is = 0, where the gradient with respect to its n vanishes.
  const RefineEnd end = Refine(problem, {3.8, 2e-8, 1.2, 0.25, 300, 0, 1.5});
  EXPECT_GT(end.p[5], 0);
  EXPECT_LT(std::sqrt(end.mean_square), 2e-5);
}

TEST(SeparableDescent, ComesNextToTheOptimumFromFarAway) {
  for (const Objective objective : kBoth) {
    const RefineProblem problem =
        ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode, kTwoDiodeTruth, 1e-3, objective);
    const std::vector<double> near = SeparableDescent(problem, {1, 1e-5, 1.9, 2, 5, 1e-9, 1.1});
    const RefineEnd end = Refine(problem, near);
    EXPECT_LT(MeanSquare(problem, near) / end.mean_square, 1.001) << ToText(objective);
  }
}

TEST(SeparableStarts, AreSortedDistinctAndInsideTheBounds) {
  const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kTripleDiode,
                                              kTwoDiodeTruth, 1e-3, Objective::kSolvedCurrent);
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

// A cell whose current was fixed at a limit beyond open circuit, which no diode model fits.
RefineProblem ClippedProblem() {
  Conditions conditions;
  const std::vector<double> truth = {0.038, 4e-10, 1.2, 0.3, 2900};
  std::vector<double> voltage;
  for (int k = 0; k < 83; ++k) voltage.push_back(-0.1 + 0.01 * k);
  const Device device = MakeDevice(Model::kSingleDiode, conditions);
  std::vector<double> current = SolveCurrents(device, truth.data(), voltage);
  for (double& i : current) i = std::max(i, -0.05);
  return MakeRefineProblem(device, Objective::kSolvedCurrent, voltage, current, {},
                           {0, 0, 1, 0, 0.5}, {0.1, 1e-4, 2, 11, 1e13});
}

TEST(RefineFrom, NeverEndsAboveItsStart) {
  const RefineProblem problem = ClippedProblem();
  int astray = 0;
  for (const double is : {8e-12, 1.6e-11, 3e-11}) {
    for (const double rs : {1.0, 1.5, 1.85, 2.0}) {
      const std::vector<double> start = {0.041, is, 1.01, rs, 175};
      const double before = MeanSquare(problem, start);
      EXPECT_LE(RefineFrom(problem, start).mean_square, before * (1 + 1e-9)) << is << ' ' << rs;
      EXPECT_LE(Refine(problem, start).mean_square, before * (1 + 1e-9)) << is << ' ' << rs;
      astray += MeanSquare(problem, SeparableDescent(problem, start)) > before;
    }
  }
  EXPECT_GT(astray, 0);  // otherwise this curve tests nothing
}

TEST(Refine, HandsNothingToTheSolverThatIsNotFinite) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  testing::internal::CaptureStderr();
  for (int i = 0; i < 5; ++i) {
    std::vector<double> start = kSingleTruth;
    start[i] = std::nan("");
    EXPECT_FALSE(Refine(problem, start).converged) << i;
    EXPECT_FALSE(RefinePlainly(problem, start).converged) << i;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Refine, StopsWithinAnIteration) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  RefineOptions how;
  int asked = 0;
  how.stop = StopToken([&] { return ++asked > 2; });
  const RefineEnd end = Refine(problem, {3.7, 1e-7, 1.3, 0.2, 200}, how);
  EXPECT_FALSE(end.converged);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace lyrefit
