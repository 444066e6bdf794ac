#include "lyrefit/base/median.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

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
