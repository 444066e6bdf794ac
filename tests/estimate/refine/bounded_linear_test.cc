#include "lyrefit/estimate/refine/bounded_linear.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

// A random problem, some of whose unknowns are fixed.
struct Problem {
  Problem(RandomStream* random, int columns)
      : a(12, columns), b(12), lower(columns), upper(columns) {
    for (int i = 0; i < a.rows(); ++i) {
      b[i] = random->Normal();
      for (int j = 0; j < columns; ++j) a(i, j) = random->Normal();
    }
    for (int j = 0; j < columns; ++j) {
      lower[j] = random->Normal();
      upper[j] = lower[j] + (random->Index(5) == 0 ? 0 : random->Uniform());
    }
  }

  Eigen::VectorXd ByGram() const {
    return SolveBoundedLinear(a.transpose() * a, a.transpose() * b, lower, upper);
  }
  Eigen::VectorXd ByColumns() const { return SolveBoundedColumns(a, b, lower, upper, lower); }
  double Left(const Eigen::VectorXd& x) const { return (a * x - b).norm(); }

  // No unknown can move within its bounds and lower the sum of squares.
  void ExpectOptimal(const Eigen::VectorXd& x, double rounding) const {
    const Eigen::VectorXd pull = a.transpose() * (b - a * x);
    for (int j = 0; j < x.size(); ++j) {
      ASSERT_GE(x[j], lower[j]);
      ASSERT_LE(x[j], upper[j]);
      if (x[j] > lower[j]) {
        EXPECT_GE(pull[j], -rounding);
      }
      if (x[j] < upper[j]) {
        EXPECT_LE(pull[j], rounding);
      }
    }
  }

  Eigen::MatrixXd a;
  Eigen::VectorXd b, lower, upper;
};

TEST(BoundedLinear, BothWaysMeetTheOptimalityConditionsAndAgree) {
  RandomStream random(11);
  int at_bounds = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const Problem problem(&random, 1 + static_cast<int>(random.Index(5)));
    const Eigen::VectorXd gram = problem.ByGram(), columns = problem.ByColumns();
    problem.ExpectOptimal(gram, 1e-12);
    problem.ExpectOptimal(columns, 1e-13);
    EXPECT_LT((gram - columns).norm(), 1e-11);
    for (int j = 0; j < gram.size(); ++j) {
      const bool held = gram[j] == problem.lower[j] || gram[j] == problem.upper[j];
      EXPECT_EQ(columns[j] == problem.lower[j] || columns[j] == problem.upper[j], held);
      at_bounds += held ? 1 : 0;
    }
  }
  EXPECT_GT(at_bounds, 1000);
}

// The solution is not unique, the sum of squares is.
TEST(BoundedLinear, BothWaysTakeDependentColumns) {
  RandomStream random(12);
  for (int draw = 0; draw < 2000; ++draw) {
    Problem problem(&random, 4);
    if (draw % 2 == 0) problem.a.col(3) = problem.a.col(1);
    if (draw % 2 == 1) problem.a.col(3) = problem.a.col(0) - problem.a.col(2);
    const Eigen::VectorXd gram = problem.ByGram(), columns = problem.ByColumns();
    problem.ExpectOptimal(gram, 1e-12);
    problem.ExpectOptimal(columns, 1e-13);
    EXPECT_NEAR(problem.Left(gram), problem.Left(columns), 1e-13);
  }
}

// Proofs need a residual that is orthogonal to every free column to the last digits.
TEST(BoundedLinear, ColumnsKeepTheDigitsOfNearlyParallelColumns) {
  RandomStream random(13);
  for (int draw = 0; draw < 2000; ++draw) {
    Problem problem(&random, 3);
    problem.a.col(2) = problem.a.col(1) + 1e-6 * problem.a.col(2);
    problem.lower.setZero();
    problem.upper.setConstant(draw % 2 == 0 ? 10 : std::numeric_limits<double>::infinity());
    problem.b = problem.a * Eigen::Vector3d(1, 0.5, draw % 3) + 1e-6 * problem.b;
    const Eigen::VectorXd columns = problem.ByColumns();
    problem.ExpectOptimal(columns, 1e-13);
    if (draw % 2 == 0) {
      EXPECT_LT(problem.Left(columns), problem.Left(problem.ByGram()) + 1e-14);
    }
  }
}

}  // namespace
}  // namespace lyrefit
