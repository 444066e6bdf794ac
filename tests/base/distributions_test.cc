#include "lyrefit/base/distributions.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

// Against printed tables.
TEST(DistributionsTest, TailsAndQuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(NormalTail(1.959964), 0.025, 1e-8);
  EXPECT_NEAR(NormalAbove(0.025), 1.959964, 1e-6);
  EXPECT_NEAR(ChiSquaredTail(15.507, 8), 0.05, 1e-5);
  EXPECT_NEAR(FisherTail(4.9646, 1, 10), 0.05, 1e-5);
  EXPECT_NEAR(StudentQuantile(0.975, 10), 2.228, 5e-4);
}

}  // namespace
}  // namespace lyrefit
