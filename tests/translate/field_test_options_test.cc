#include "lyrefit/translate/field_test_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../error_of.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(ReadTolerance, KnowsPerCentAndWatt) {
  for (const char* text : {"-0,+5", "-0%,+5%", "0,5"}) {
    const auto tolerance = ReadTolerance(text);
    ASSERT_TRUE(tolerance) << text;
    EXPECT_EQ(tolerance->low, 0);
    EXPECT_EQ(tolerance->high, 5);
    EXPECT_FALSE(tolerance->in_W);
  }
  for (const char* text : {"-3W,+5W", "-3,+5W"}) {
    const auto watt = ReadTolerance(text);
    ASSERT_TRUE(watt) << text;
    EXPECT_EQ(watt->low, -3);
    EXPECT_EQ(watt->high, 5);
    EXPECT_TRUE(watt->in_W);
  }
  const auto both = ReadTolerance("3");
  ASSERT_TRUE(both);
  EXPECT_EQ(both->low, -3);
  EXPECT_EQ(both->high, 3);
}

TEST(ReadTolerance, RefusesWhatIsNone) {
  for (const char* text : {"a", "-0,b", "", "W", "1,2,3"}) {
    EXPECT_FALSE(ReadTolerance(text)) << text;
  }
  EXPECT_THAT(MessageOf(ReadTolerance("+1,+5")), HasSubstr("holds the rating"));
  EXPECT_THAT(MessageOf(ReadTolerance("-3W,+5%")), HasSubstr("one unit"));
}

TEST(ToleranceText, ReadsBack) {
  for (const char* text : {"-0,+5", "-3W,+5W"}) {
    EXPECT_EQ(ToleranceText(*ReadTolerance(text)), text);
  }
}

}  // namespace
}  // namespace lyrefit
