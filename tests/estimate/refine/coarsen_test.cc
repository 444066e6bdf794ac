#include "lyrefit/estimate/refine/coarsen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "estimate/refine/test_curves.h"
#include "lyrefit/estimate/refine/profile.h"
#include "lyrefit/estimate/refine/refine.h"
#include "repeats.h"

namespace lyrefit {
namespace {

constexpr int kMany = 1000;

TEST(Coarsen, LeavesFewPointsAsTheyAre) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const RefineProblem coarse = Coarsen(problem);
  EXPECT_EQ(coarse.voltage_V, problem.voltage_V);
  EXPECT_EQ(coarse.current_A, problem.current_A);
}

TEST(Coarsen, KeepsTheSumOfSquaresAroundTheOptimum) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    const RefineProblem problem = ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode,
                                                kTwoDiodeTruth, 3e-3, objective, 1, kMany);
    const RefineProblem coarse = Coarsen(problem);
    EXPECT_LE(coarse.points.size, 256);
    EXPECT_EQ(coarse.resistance_scale(), problem.resistance_scale());
    const RefineEnd best = Refine(problem, kTwoDiodeTruth);
    EXPECT_NEAR(MeanSquare(coarse, best.p) / best.mean_square, 1, 0.01);
    for (int i = 0; i < problem.device.size(); ++i) {
      std::vector<double> moved = best.p;
      moved[i] *= i == kRsh ? 1.1 : 1.01;
      const double rise = MeanSquare(problem, moved) - best.mean_square;
      const double thin_rise = MeanSquare(coarse, moved) - MeanSquare(coarse, best.p);
      EXPECT_NEAR(thin_rise, rise, 0.01 * rise + 1e-4 * best.mean_square) << i;
    }
  }
}

// The current is a smooth function of the voltage, so that quadrature keeps its sum of squares far
// more accurately than piecewise linear interpolation.
TEST(Coarsen, KeepsTheSumOfSquaresOfASmoothCurrent) {
  const RefineProblem problem =
      ModuleProblem(Model::kDoubleDiode, Model::kDoubleDiode, kTwoDiodeTruth, 3e-3,
                    Objective::kSolvedCurrent, 1, kMany);
  const RefineProblem coarse = Coarsen(problem);
  EXPECT_LE(coarse.points.size, 128);
  for (int i = 0; i < problem.device.size(); ++i) {
    std::vector<double> moved = kTwoDiodeTruth;
    moved[i] *= i == kRsh ? 1.1 : 1.01;
    EXPECT_NEAR(MeanSquare(coarse, moved) / MeanSquare(problem, moved), 1, 1e-4) << i;
  }
}

TEST(Coarsen, StandsForReadingsAtAFewVoltages) {
  const RefineProblem sparse = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth,
                                             3e-3, Objective::kSolvedCurrent, 1, 30);
  std::vector<double> voltage, current;
  for (int k = 0; k < kMany; ++k) {
    voltage.push_back(sparse.voltage_V[k % 30]);
    current.push_back(sparse.current_A[k % 30] + (k % 7 - 3) * 1e-3);
  }
  const RefineProblem many = MakeRefineProblem(sparse.device, sparse.objective, voltage, current,
                                               {}, sparse.lower, sparse.upper);
  const RefineProblem coarse = Coarsen(many);
  EXPECT_LE(coarse.points.size, 128);
  EXPECT_NEAR(MeanSquare(coarse, kSingleTruth) / MeanSquare(many, kSingleTruth), 1, 1e-6);
}

TEST(Coarsen, CountsEveryPointWithItsWeight) {
  RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth,
                                        3e-3, Objective::kSolvedCurrent, 1, kMany);
  std::vector<double> weights(kMany, 1);
  std::vector<double> spoiled = problem.current_A;
  for (int k = 300; k < 600; ++k) weights[k] = 1e-12, spoiled[k] += 1;
  const RefineProblem weighted =
      MakeRefineProblem(problem.device, problem.objective, problem.voltage_V, spoiled, weights,
                        problem.lower, problem.upper);
  const RefineEnd all = Refine(weighted, kSingleTruth);
  const RefineEnd coarse = Refine(Coarsen(weighted), kSingleTruth);
  EXPECT_NEAR(coarse.p[kIph] / all.p[kIph], 1, 1e-5);
  EXPECT_NEAR(coarse.p[2] / all.p[2], 1, 1e-3);
}

struct Case {
  const char* name;
  Model truth;
  Model fitted;
  std::vector<double> p;
};

// The interval on the coarsened data is that on all points to 1 % of its half width. Ends at bounds
// agree exactly.
TEST(Coarsen, GivesTheProfileOfAllPoints) {
  const Case cases[] = {
      {"sd", Model::kSingleDiode, Model::kSingleDiode, kSingleTruth},
      {"dd", Model::kDoubleDiode, Model::kDoubleDiode, kTwoDiodeTruth},
      {"dd at its bounds", Model::kSingleDiode, Model::kDoubleDiode, kSingleTruth},
      {"td", Model::kDoubleDiode, Model::kTripleDiode, kTwoDiodeTruth},
  };
  for (const Case& c : cases) {
    // half a minute more without new code
    if (kSanitized && c.fitted != Model::kSingleDiode) continue;
    for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
      const RefineProblem all = ModuleProblem(c.truth, c.fitted, c.p, 3e-3, objective, 2, kMany);
      std::vector<double> start = c.p;
      for (int i = static_cast<int>(start.size()); i < all.device.size(); ++i) {
        start.push_back(i % 2 == 1 ? 1e-8 : 1.5);
      }
      const RefineEnd best = RefineFrom(all, start);
      const RefineProblem coarse = Coarsen(all);
      const RefineEnd coarse_best = Refine(coarse, best.p);
      const int degrees = kMany - all.device.size();
      const Spread spread = SpreadOf(all, best, degrees);
      for (const int i : {kIph + 0, kRs + 0, kRsh + 0}) {
        const double error = spread.standard_error[i];
        double value[2][2];
        for (const bool upper : {false, true}) {
          const auto side = [&](const RefineProblem& problem, const RefineEnd& end) {
            const double variance = VarianceOf(problem, end, degrees);
            return FindProfileSide(problem, end, {i, upper, 1.962, variance, error});
          };
          const ProfileSide full = side(all, best);
          const ProfileSide of_coarse = side(coarse, coarse_best);
          EXPECT_TRUE(full.settled && of_coarse.settled) << c.name << ' ' << i;
          EXPECT_EQ(of_coarse.at_bound, full.at_bound) << c.name << ' ' << i;
          value[0][upper] = full.value;
          value[1][upper] = of_coarse.value;
        }
        const double half = 0.5 * (value[0][1] - value[0][0]);
        EXPECT_NEAR(value[1][0], value[0][0], 0.01 * half)
            << c.name << ' ' << i << ' ' << ToText(objective);
        EXPECT_NEAR(value[1][1], value[0][1], 0.01 * half)
            << c.name << ' ' << i << ' ' << ToText(objective);
      }
    }
  }
}

}  // namespace
}  // namespace lyrefit
