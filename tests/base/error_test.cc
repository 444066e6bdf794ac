#include "lyrefit/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "lyrefit/base/reasons.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

TEST(ErrorTest, NamesFileLineAndColumnAsFarAsKnown) {
  EXPECT_EQ((Error{"wrong", "a.csv", 7, 3}).ToString(), "a.csv:7:3: wrong");
  EXPECT_EQ((Error{"wrong", "a.csv", 7, 0}).ToString(), "a.csv:7: wrong");
  EXPECT_EQ((Error{"wrong", "a.csv", 0, 0}).ToString(), "a.csv: wrong");
  EXPECT_EQ((Error{"wrong", "", 7, 3}).ToString(), "line 7:3: wrong");
  EXPECT_EQ((Error{"wrong", "", 0, 0}).ToString(), "wrong");
}

TEST(ErrorTest, ColumnWithoutLineIsNotShown) {
  EXPECT_EQ((Error{"wrong", "a.csv", 0, 3}).ToString(), "a.csv: wrong");
}

TEST(ErrorTest, FailConvertsToAnyExpected) {
  const Expected<int> number = Fail("wrong", "a.csv", 1, 2);
  ASSERT_FALSE(number);
  EXPECT_EQ(number.error().file, "a.csv");
  EXPECT_EQ(number.error().line, 1);
  EXPECT_EQ(number.error().column, 2);
  const Expected<void> nothing = Fail("wrong");
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message, "wrong");
}

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

using ::testing::ElementsAre;

TEST(ReasonsTest, NumbersAndFoundValuesAreReplaced) {
  EXPECT_EQ(WithoutNumbers("3 points at 12.5 V, expected 5."), "N points at N V, expected N.");
  EXPECT_EQ(WithoutNumbers("expected a number, found 'abc'"), "expected a number, found 'N'");
  EXPECT_EQ(WithoutNumbers("the module's current -1.5e-03 A"), "the module's current -N A");
  EXPECT_EQ(WithoutNumbers(""), "");
}

TEST(ReasonsTest, AReasonIsToldOnceWithTheNumberOfTheOthers) {
  EXPECT_THAT(
      OncePerKind({"line 4: found 'x'", "no light", "line 9: found 'y'", "line 11: found 'z'"}),
      ElementsAre("line 4: found 'x' (and 2 more of the kind)", "no light"));
}

}  // namespace
}  // namespace lyrefit
