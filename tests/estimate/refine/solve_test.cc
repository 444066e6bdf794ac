#include "lyrefit/estimate/refine/solve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/refine/decay_model.h"
#include "estimate/refine/test_curves.h"

namespace lyrefit {
namespace {

SolveOptions Thorough() {
  SolveOptions options;
  options.max_iterations = 100;
  options.function_tolerance = 1e-15;
  options.trust_radius = 1e10;
  options.unit_A = kDecayNoise;
  return options;
}

SolveEnd SolveFrom(const Decay& model, std::vector<double> p, const std::vector<bool>& active,
                   const SolveOptions& options) {
  const Coordinates coordinates(model.shape(), std::move(p), active);
  return SolveModel(model, coordinates, {0, 0}, options);
}

TEST(SolveModel, FindsWhatIsSharedAndWhatIsNotWhicheverIsHeld) {
  const Decay model(1);
  const SolveEnd all = SolveFrom(model, {0.5, 3}, {false, false}, Thorough());
  EXPECT_TRUE(all.converged);
  ASSERT_EQ(all.theta.size(), 2U);
  EXPECT_NEAR(all.theta[0], 2, 0.02);
  EXPECT_NEAR(all.theta[1], 0.7, 0.02);
  // From the optimum, the local unknowns alone end at their optimal values.
  const SolveEnd own = SolveFrom(model, all.theta, {true, true}, Thorough());
  EXPECT_TRUE(own.converged);
  EXPECT_TRUE(own.theta.empty());
  for (int b = 0; b < 2; ++b) EXPECT_NEAR(own.local[b], all.local[b], 1e-7);
}

TEST(SolveModel, StaysWithinBoundsWhereItIsAskedTo) {
  const Decay model(1, 0.9);
  SolveOptions options = Thorough();
  EXPECT_LT(SolveFrom(model, {0.5, 3}, {false, false}, options).theta[1], 0.9);
  options.bounded = true;
  EXPECT_NEAR(SolveFrom(model, {0.5, 3}, {false, false}, options).theta[1], 0.9, 1e-6);
  EXPECT_GE(SolveFrom(model, {0.5, 0.1}, {false, false}, options).theta[1], 0.9) << "from outside";
}

TEST(SolveModel, EndsWhenAskedToAndAtItsTarget) {
  const Decay model(1);
  SolveOptions options = Thorough();
  int asked = 0;
  options.stop = StopToken([&] { return ++asked > 2; });
  const SolveEnd stopped = SolveFrom(model, {0.5, 3}, {false, false}, options);
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(asked, 3);
  options.stop = {};
  options.target = HUGE_VAL;
  const SolveEnd low = SolveFrom(model, {0.5, 3}, {false, false}, options);
  EXPECT_FALSE(low.stopped);
  EXPECT_EQ(low.theta, (std::vector<double>{0.5, 3}));
}

TEST(SolveModel, HandsNothingToTheSolverThatIsNotFinite) {
  const Decay model(1);
  testing::internal::CaptureStderr();
  const SolveEnd end = SolveFrom(model, {std::nan(""), 3}, {false, false}, Thorough());
  EXPECT_FALSE(end.converged);
  EXPECT_EQ(end.iterations, 0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(SolveModel, EndsAlikeByEitherSolver) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const CurveModel model(problem);
  const Coordinates coordinates(model.shape(), {3.7, 4e-8, 1.25, 0.2, 200},
                                std::vector<bool>(5, false));
  SolveOptions options = Thorough();
  options.unit_A = 3e-3;
  for (const bool bounded : {false, true}) {
    options.bounded = bounded;
    options.small = false;
    const SolveEnd ceres = SolveModel(model, coordinates, {}, options);
    options.small = true;
    const SolveEnd small = SolveModel(model, coordinates, {}, options);
    EXPECT_TRUE(small.converged);
    EXPECT_LT(small.iterations, 20);
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(small.theta[k] / ceres.theta[k], 1, 1e-5) << k;
  }
  options.stop = StopToken([] { return true; });
  EXPECT_TRUE(SolveModel(model, coordinates, {}, options).stopped);
  options.stop = {};
  options.cutoff = 1;  // the noise alone leaves about 35
  const SolveEnd out_of_reach = SolveModel(model, coordinates, {}, options);
  EXPECT_TRUE(out_of_reach.hopeless);
  EXPECT_FALSE(out_of_reach.converged);
}

}  // namespace
}  // namespace lyrefit
