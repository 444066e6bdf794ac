#include "lyrefit/refine/bounded_linear.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

TEST(SolveBoundedLinear, MeetsTheOptimalityConditionsOnRandomProblems) {
  RandomStream random(11);
  for (int draw = 0; draw < 2000; ++draw) {
    const int rows = 8, columns = 1 + static_cast<int>(random.Index(5));
    Eigen::MatrixXd a(rows, columns);
    Eigen::VectorXd b(rows), lower(columns), upper(columns);
    for (int i = 0; i < rows; ++i) {
      b[i] = random.Normal();
      for (int j = 0; j < columns; ++j) a(i, j) = random.Normal();
    }
    for (int j = 0; j < columns; ++j) {
      lower[j] = random.Normal();
      upper[j] = lower[j] + (random.Index(5) == 0 ? 0 : random.Uniform());
    }
    const Eigen::VectorXd x =
        SolveBoundedLinear(a.transpose() * a, a.transpose() * b, lower, upper);
    const Eigen::VectorXd pull = a.transpose() * (b - a * x);
    for (int j = 0; j < columns; ++j) {
      ASSERT_GE(x[j], lower[j]);
      ASSERT_LE(x[j], upper[j]);
      if (x[j] > lower[j] && x[j] < upper[j]) {
        EXPECT_NEAR(pull[j], 0, 1e-8);
      }
      if (lower[j] == upper[j]) continue;
      if (x[j] == lower[j]) {
        EXPECT_LE(pull[j], 1e-8);
      } else if (x[j] == upper[j]) {
        EXPECT_GE(pull[j], -1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace lyrefit
