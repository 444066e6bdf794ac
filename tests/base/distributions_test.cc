#include "lyrefit/base/distributions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

// Comparison with printed tables.
TEST(DistributionsTest, TailsAndQuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(NormalTail(1.959964), 0.025, 1e-8);
  EXPECT_NEAR(NormalAbove(0.025), 1.959964, 1e-6);
  EXPECT_NEAR(ChiSquaredTail(15.507, 8), 0.05, 1e-5);
  EXPECT_NEAR(FisherTail(4.9646, 1, 10), 0.05, 1e-5);
  EXPECT_NEAR(StudentQuantile(0.975, 10), 2.228, 5e-4);
}

// Comparison with closed forms, to double precision.
TEST(DistributionsTest, TailsAndQuantilesAreExactInDoublePrecision) {
  constexpr double kPart = 1e-13;
  for (const double x : {-3.0, 0.5, 2.0, 6.0, 12.0}) {
    const double tail = 0.5 * std::erfc(x / std::sqrt(2.0));
    EXPECT_NEAR(NormalTail(x) / tail, 1, kPart) << x;
    EXPECT_NEAR(NormalAbove(tail), x, 1e-12 * (1 + std::fabs(x))) << x;
  }
  for (const double x : {0.1, 3.0, 15.507, 80.0}) {
    double sum = 0, term = 1;
    for (int k = 0; k < 4; ++k) {
      sum += term;
      term *= 0.5 * x / (k + 1);
    }
    EXPECT_NEAR(ChiSquaredTail(x, 8) / (std::exp(-0.5 * x) * sum), 1, kPart) << x;
    EXPECT_NEAR(FisherTail(x, 2, 10) / std::pow(1 + 0.2 * x, -5), 1, 1e-12) << x;
  }
  for (const double p : {0.6, 0.95, 0.975, 0.9999}) {
    EXPECT_NEAR(StudentQuantile(p, 1) / std::tan(M_PI * (p - 0.5)), 1, 1e-11) << p;
    EXPECT_NEAR(StudentQuantile(p, 2) / ((2 * p - 1) / std::sqrt(2 * p * (1 - p))), 1, 1e-11) << p;
  }
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(Median({3, 1, 2}), 2);
  EXPECT_EQ(Median({4, 1, 3, 2}), 2.5);
  EXPECT_TRUE(std::isnan(Median({})));
}

TEST(Median, TheUpperOneWasMeasured) {
  EXPECT_EQ(UpperMedian({3, 1, 2}), 2);
  EXPECT_EQ(UpperMedian({4, 1, 3, 2}), 3);
  EXPECT_TRUE(std::isnan(UpperMedian({})));
}

TEST(RobustScale, IsTheStandardDeviationOfNormalValues) {
  EXPECT_DOUBLE_EQ(RobustScale({-3, 1, 2}), 1.4826 * 2);
  EXPECT_DOUBLE_EQ(RobustScale({4, -1, 3, 2}), 1.4826 * 2.5);
  EXPECT_DOUBLE_EQ(RobustScale({4, -1, 3, 2}, UpperMedian), 1.4826 * 3);
  EXPECT_TRUE(std::isnan(RobustScale({})));
}

TEST(HuberWeight, FallsBeyondTheLimit) {
  EXPECT_EQ(HuberWeight(1.5, 1.5), 1);
  EXPECT_EQ(HuberWeight(3, 1.5), 0.5);
}

}  // namespace
}  // namespace lyrefit
