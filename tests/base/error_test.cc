#include "lyrefit/base/error.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lyrefit
