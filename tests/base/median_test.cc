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

}  // namespace
}  // namespace lyrefit
