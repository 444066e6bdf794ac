#include "lyrefit/estimate/refine/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lyrefit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LeastSquaresProblem Unbounded(int parameters, int residuals) {
  LeastSquaresProblem problem;
  problem.residuals = residuals;
  problem.lower.assign(parameters, -kInfinity);
  problem.upper.assign(parameters, kInfinity);
  return problem;
}

// Rosenbrock's function: optimum at (1, 1).
LeastSquaresProblem Rosenbrock() {
  LeastSquaresProblem problem = Unbounded(2, 2);
  problem.evaluate = [](const double* p, double* r, double* jacobian) {
    r[0] = 10 * (p[1] - p[0] * p[0]);
    r[1] = 1 - p[0];
    if (jacobian != nullptr) {
      const double rows[] = {-20 * p[0], 10, -1, 0};
      for (int k = 0; k < 4; ++k) jacobian[k] = rows[k];
    }
    return true;
  };
  return problem;
}

TEST(LeastSquaresTest, FindsTheOptimum) {
  const LeastSquaresEnd end = SolveLeastSquares(Rosenbrock(), {-1.2, 1});
  EXPECT_TRUE(end.usable);
  EXPECT_TRUE(end.converged);
  EXPECT_GT(end.iterations, 1);
  EXPECT_NEAR(end.p[0], 1, 1e-6);
  EXPECT_NEAR(end.p[1], 1, 1e-6);
  EXPECT_LT(end.sum_of_squares, 1e-12);
}

TEST(LeastSquaresTest, StopsAtBounds) {
  LeastSquaresProblem problem = Rosenbrock();
  problem.upper = {0.5, kInfinity};
  const LeastSquaresEnd end = SolveLeastSquares(problem, {-1.2, 1});
  EXPECT_DOUBLE_EQ(end.p[0], 0.5);
  EXPECT_NEAR(end.p[1], 0.25, 1e-6);
  EXPECT_NEAR(end.sum_of_squares, 0.25, 1e-9);
}

TEST(LeastSquaresTest, MovesAStartInsideTheBounds) {
  LeastSquaresProblem problem = Rosenbrock();
  problem.lower = {-2, -2};
  problem.upper = {2, 2};
  const LeastSquaresEnd end = SolveLeastSquares(problem, {50, -50});
  EXPECT_TRUE(end.usable);
  EXPECT_NEAR(end.p[0], 1, 1e-5);
}

// A parameter without influence stays unchanged, whatever the sign of its zero derivative and
// whichever bound is nearer.
TEST(LeastSquaresTest, WhatNothingHangsOnStays) {
  LeastSquaresProblem problem = Unbounded(3, 2);
  problem.lower[2] = -1;
  problem.upper[2] = 1;
  for (const double sign : {1.0, -1.0}) {
    problem.evaluate = [sign](const double* p, double* r, double* jacobian) {
      r[0] = 10 * (p[1] - p[0] * p[0]);
      r[1] = 1 - p[0];
      const double rows[] = {-20 * p[0], 10, sign * 0.0, -1, 0, sign * 0.0};
      for (int k = 0; k < 6; ++k) jacobian[k] = rows[k];
      return true;
    };
    for (const double there : {-0.25, 0.0, 0.25}) {
      const LeastSquaresEnd end = SolveLeastSquares(problem, {-1.2, 1, there});
      EXPECT_EQ(end.p[2], there);
      EXPECT_NEAR(end.p[0], 1, 1e-6);
    }
  }
}

TEST(LeastSquaresTest, HeldParametersStay) {
  LeastSquaresProblem problem = Rosenbrock();
  problem.fixed = {1, 0};
  const LeastSquaresEnd end = SolveLeastSquares(problem, {0.3, 7});
  EXPECT_EQ(end.p[0], 0.3);
  EXPECT_NEAR(end.p[1], 0.09, 1e-6);
  EXPECT_NEAR(end.sum_of_squares, 0.49, 1e-9);
}

TEST(LeastSquaresTest, WithAllHeldOnlyMeasures) {
  LeastSquaresProblem problem = Rosenbrock();
  problem.fixed = {1, 1};
  const LeastSquaresEnd end = SolveLeastSquares(problem, {0, 1});
  EXPECT_TRUE(end.usable);
  EXPECT_TRUE(end.converged);
  EXPECT_EQ(end.p, (std::vector<double>{0, 1}));
  EXPECT_DOUBLE_EQ(end.sum_of_squares, 101);
}

TEST(LeastSquaresTest, AnUnusableStartIsSaidToBe) {
  LeastSquaresProblem problem = Rosenbrock();
  problem.evaluate = [](const double*, double*, double*) { return false; };
  const LeastSquaresEnd end = SolveLeastSquares(problem, {-1.2, 1});
  EXPECT_FALSE(end.usable);
  EXPECT_EQ(end.p, (std::vector<double>{-1.2, 1}));
}

// Where the model cannot be evaluated, steps are shortened.
TEST(LeastSquaresTest, StepsBackFromWhereTheModelEnds) {
  LeastSquaresProblem problem = Unbounded(1, 1);
  problem.evaluate = [](const double* p, double* r, double* jacobian) {
    if (!(p[0] > 0)) return false;
    r[0] = std::log(p[0]) + 3;
    if (jacobian != nullptr) jacobian[0] = 1 / p[0];
    return true;
  };
  const LeastSquaresEnd end = SolveLeastSquares(problem, {5});
  EXPECT_TRUE(end.usable);
  EXPECT_NEAR(end.p[0], std::exp(-3), 1e-6);
}

TEST(LeastSquaresTest, NeverEndsAboveItsStart) {
  LeastSquaresOptions options;
  options.max_iterations = 1;
  const LeastSquaresEnd end = SolveLeastSquares(Rosenbrock(), {-1.2, 1}, options);
  EXPECT_LE(end.sum_of_squares, 24.2 + 1e-9);
  EXPECT_FALSE(end.converged);
}

TEST(LeastSquaresTest, GivesUpWhereOthersWereBetter) {
  LeastSquaresProblem problem = Rosenbrock();
  problem.lower = {3, -kInfinity};
  LeastSquaresOptions options;
  const LeastSquaresEnd all = SolveLeastSquares(problem, {5, 1}, options);
  EXPECT_NEAR(all.sum_of_squares, 4, 1e-6);
  options.cutoff = 1;
  const LeastSquaresEnd beaten = SolveLeastSquares(problem, {5, 1}, options);
  EXPECT_LT(beaten.iterations, all.iterations);
  EXPECT_FALSE(beaten.converged);
  options.cutoff = 5;
  EXPECT_NEAR(SolveLeastSquares(problem, {5, 1}, options).sum_of_squares, 4, 1e-6);
}

}  // namespace
}  // namespace lyrefit
