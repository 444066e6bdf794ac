#include "lyrefit/base/reasons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

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
