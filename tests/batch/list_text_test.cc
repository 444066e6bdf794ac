#include "lyrefit/stream/row_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

std::vector<double> Values(std::string_view text) {
  Record list;
  ParseList(text, 1, &list);
  return list.values;
}

TEST(ParseList, TakesEverySeparator) {
  const std::vector<double> wanted = {0, 1.5, -2e-3};
  for (const char* text : {"0 1.5 -2e-3", "0;1.5;-2e-3", "0|1.5|-2e-3|", "0,1.5,-2e-3",
                           "[0, 1.5, -2e-3]", "[0 1.5 -2e-3]", " ( 0 ; 1.5 ; -2e-3 ) ",
                           "0,0 1,5 -0,002", "0;1,5;-0,002", "  0   1.5\t-2e-3 "}) {
    EXPECT_EQ(Values(text), wanted) << text;
  }
  EXPECT_TRUE(Values("").empty());
  EXPECT_TRUE(Values("[]").empty());
}

TEST(ParseList, RemembersTheFirstThatIsNoNumber) {
  Record list;
  ParseList("0;;x;3", 7, &list);
  ASSERT_EQ(list.values.size(), 4U);
  EXPECT_TRUE(std::isnan(list.values[1]) && std::isnan(list.values[2]));
  EXPECT_EQ(list.bad, "x");
  EXPECT_EQ(list.bad_at, 2U);
  EXPECT_EQ(list.bad_column, 7);
  EXPECT_TRUE(list.bad_is_text);
}

TEST(IsList, TellsListsFromOtherFields) {
  for (const char* text : {"0 1", "[1,2,3]", "1;2;x"}) EXPECT_TRUE(IsList(text)) << text;
  for (const char* text : {"", "12.5", "2026-05-01 10:00", "a b c", "1 a b"}) {
    EXPECT_FALSE(IsList(text)) << text;
  }
}

TEST(ParsePairs, TakesVoltageAndCurrentFromOneField) {
  for (const char* text : {"V*I#0*8#1*7#", "0*8#1*7", "I*V#8*0#7*1", "0:8;1:7", "0:8 1:7"}) {
    Records fields;
    ASSERT_TRUE(ParsePairs(text, 1, &fields)) << text;
    const bool turned = fields.lists[0].name == "I";
    EXPECT_EQ(fields.lists[turned ? 1 : 0].values, (std::vector<double>{0, 1})) << text;
    EXPECT_EQ(fields.lists[turned ? 0 : 1].values, (std::vector<double>{8, 7})) << text;
  }
  Records fields;
  for (const char* text : {"", "NA", "0 1 2", "V*I#"}) {
    EXPECT_FALSE(ParsePairs(text, 1, &fields)) << text;
  }
  EXPECT_TRUE(fields.lists.empty());
}

}  // namespace
}  // namespace lyrefit
