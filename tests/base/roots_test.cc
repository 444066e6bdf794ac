#include "lyrefit/base/roots.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(RootBetween, IsExactToTheLastBit) {
  const auto square = [](double x) { return x * x - 2; };
  EXPECT_DOUBLE_EQ(RootBetween(square, 0, 2), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(RootBetween([&](double x) { return -square(x); }, 0, 2), std::sqrt(2.0));
  EXPECT_EQ(RootBetween(square, 3, 5), 3) << "no root: the nearer end";
  EXPECT_EQ(RootBetween(square, -9, -3), -3);
  EXPECT_DOUBLE_EQ(RootBetween(square, 2, 0), std::sqrt(2.0)) << "ends in the other order";
}

TEST(LastWhere, EndsBesideTheFirstNumberThatDoesNotHold) {
  const auto small = [](double x) { return x < 0.3; };
  EXPECT_EQ(LastWhere(small, 0, 1), std::nextafter(0.3, 0));
  const auto large = [](double x) { return x >= 0.3; };
  EXPECT_EQ(LastWhere(large, 1, 0), 0.3) << "downwards";
}

TEST(SignChange, NeedsNoFiniteValues) {
  EXPECT_DOUBLE_EQ(SignChange([](double x) { return 1 / (x - 0.3); }, 0, 1), 0.3);
  EXPECT_DOUBLE_EQ(SignChange([](double) { return 1.0; }, 0, 1), 1) << "none";
}

TEST(MaximumBetween, IsExactToHalfTheDigits) {
  EXPECT_NEAR(MaximumBetween([](double x) { return x * (3 - x); }, 0, 3), 1.5, 3e-8);
}

}  // namespace
}  // namespace lyrefit
