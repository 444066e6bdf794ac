#include "lyrefit/read/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_of.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(ParseJsonTest, ErrorsSayLineAndColumn) {
  const struct {
    const char* text;
    int line;
    int column;
  } kCases[] = {{"{\n  \"a\": 1,\n  b\n}", 3, 3},
                {"{\"a\": 1", 1, 8},
                {"{} x", 1, 4},
                {"[1, 2\n", 2, 1},
                {"{\"a\": \"\xb5\"}", 1, 8}};
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    ExpectErrorAt(ParseJson(c.text, "f.json"), "f.json", c.line, c.column, "valid JSON");
  }
}

TEST(ParseJsonTest, RefusesEndlessNesting) {
  EXPECT_TRUE(ParseJson(std::string(64, '[') + std::string(64, ']'), ""));
  EXPECT_THAT(MessageOf(ParseJson(std::string(1000000, '['), "")), HasSubstr("at most 64 levels"));
}

TEST(JsonFieldsTest, NullAndMissingAreNotGiven) {
  const nlohmann::json object = {{"a", nullptr}};
  const std::string text;
  const JsonFields fields(object, text, text);
  EXPECT_FALSE(*fields.Number({"a"}));
  EXPECT_FALSE(*fields.WholeNumber({"b"}));
  EXPECT_FALSE(*fields.Text("a"));
}

TEST(JsonFieldsTest, FirstGivenKeyCounts) {
  const nlohmann::json object = {{"a", nullptr}, {"b", 2}, {"c", 3}};
  const std::string text;
  const JsonFields fields(object, text, text);
  EXPECT_EQ(**fields.Number({"a", "b", "c"}), 2);
}

TEST(JsonFieldsTest, WrongTypeNamesKeyAndPlace) {
  const std::string text = "{\n \"a\": \"x\",\n \"b\": 1.5, \"c\": [], \"d\": true}";
  const std::string file = "f.json";
  const auto json = ParseJson(text, file);
  ASSERT_TRUE(json);
  const JsonFields fields(*json, text, file);
  EXPECT_EQ(fields.Number({"a"}).error().ToString(),
            "f.json:2:2: expected a number in \"a\", found '\"x\"'");
  EXPECT_EQ(fields.WholeNumber({"b"}).error().ToString(),
            "f.json:3:2: expected a whole number in \"b\", found '1.5'");
  EXPECT_EQ(fields.Text("c").error().message, "expected a text in \"c\", found a list");
  EXPECT_EQ(fields.Number({"d"}).error().message, "expected a number in \"d\", found 'true'");
}

TEST(NumberOrTextTest, TakesBothButOnlyFiniteNumbers) {
  EXPECT_EQ(NumberOrText(1.5), 1.5);
  EXPECT_EQ(NumberOrText("1.50"), 1.5);
  EXPECT_FALSE(NumberOrText("x"));
  EXPECT_FALSE(NumberOrText("nan"));
  EXPECT_FALSE(NumberOrText(true));
  EXPECT_FALSE(NumberOrText(nullptr));
}

TEST(DumpTest, WritesTextThatIsAlwaysJson) {
  EXPECT_EQ(Dump({{"name", "caf\xe9"}, {"unknown", std::nan("")}, {"perfect", HUGE_VAL}}),
            "{\n  \"name\": \"caf\xef\xbf\xbd\",\n  \"unknown\": null,\n  \"perfect\": null\n}\n");
}

TEST(OneLineTest, QuotesAValue) {
  EXPECT_EQ(OneLine(nlohmann::json{{"a", {1, nullptr}}}), "{\"a\":[1,null]}");
}

}  // namespace
}  // namespace lyrefit
