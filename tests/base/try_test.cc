#include "lyrefit/base/try.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

Expected<std::unique_ptr<int>> Boxed(int value) {
  if (value < 0) return Fail("below zero", "box.csv", 3, 4);
  return std::make_unique<int>(value);
}

Expected<void> Check(int value) {
  if (value > 9) return Fail("above nine");
  return {};
}

Expected<std::string> Describe(int first, int second) {
  TRY(Check(first));
  TRY(const std::unique_ptr<int> a, Boxed(first));
  TRY(const std::unique_ptr<int> b, Boxed(second));
  if (*a == 7) TRY(Check(10));
  return std::to_string(*a + *b);
}

TEST(Try, MovesTheValueOutAndGoesOn) { EXPECT_EQ(Describe(1, 2).value(), "3"); }

TEST(Try, ReturnsTheErrorOfTheFirstThatFailsWithItsPlace) {
  const auto refused = Describe(1, -2);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().ToString(), "box.csv:3:4: below zero");
}

TEST(Try, ReturnsTheErrorOfWhatHasNoValue) {
  EXPECT_EQ(Describe(10, 2).error().message, "above nine");
  EXPECT_EQ(Describe(7, 2).error().message, "above nine");
}

}  // namespace
}  // namespace lyrefit
