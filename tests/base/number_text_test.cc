#include "lyrefit/base/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

namespace lyrefit {
namespace {

TEST(ParseNumberTest, ReadsEverySpellingOfANumber) {
  const struct {
    const char* text;
    double value;
  } kCases[] = {{"1.5", 1.5},
                {"-1.5", -1.5},
                {"+1.5", 1.5},
                {".5", 0.5},
                {"5.", 5},
                {"1e-3", 1e-3},
                {"1.5E+2", 150},
                {"  2 ", 2},
                {"\u22121.5", -1.5},
                {"-0.25", -0.25},
                {"1.5e\u22123", 1.5e-3},
                {"0", 0},
                {"0.1", 0.1},
                {"4.9406564584124654e-324", 4.9406564584124654e-324}};
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    const auto value = ParseNumber(c.text);
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, c.value);
  }
}

TEST(ParseNumberTest, RefusesEverythingElse) {
  for (const char* text : {"", " ", "abc", "1.5x", "1 5", "+-1", "--1", "+", "1,5", "0x10", "1.2.3",
                           "1e999", "1e", "12:30"}) {
    SCOPED_TRACE(text);
    EXPECT_FALSE(ParseNumber(text));
  }
}

TEST(ParseNumberTest, TakesADecimalCommaOnlyWhereAllowed) {
  EXPECT_FALSE(ParseNumber("1,5", false));
  EXPECT_EQ(ParseNumber("1,5", true), 1.5);
  EXPECT_EQ(ParseNumber("-1,5e-3", true), -1.5e-3);
  EXPECT_FALSE(ParseNumber("1,2,3", true));
}

TEST(ParseNumberTest, ThousandsMayBeSetApartWhereADecimalPartShowsThem) {
  EXPECT_EQ(ParseNumber("8,892.6"), 8892.6);
  EXPECT_EQ(ParseNumber("-1,234,567.5", true), -1234567.5);
  EXPECT_EQ(ParseNumber("8.892,6", true), 8892.6);
  EXPECT_EQ(ParseNumber("+1.234.567,25", true), 1234567.25);
  EXPECT_FALSE(ParseNumber("8.892,6", false));
  for (const char* text : {"8,892", "88,92.6", "8,8926.1", ",892.6", "8892,892.6", "8,892.6.1",
                           "8,-92.6", "1.2,3.4", "8,892,.6"}) {
    EXPECT_FALSE(ParseNumber(text)) << text;
  }
}

TEST(ParseNumberTest, ThousandsMayBeSetApartByBlanksAndApostrophes) {
  EXPECT_EQ(ParseNumber("8'892.6"), 8892.6);
  EXPECT_EQ(ParseNumber("-1'234'567"), -1234567);
  EXPECT_EQ(ParseNumber("8 892.6"), 8892.6);
  EXPECT_EQ(ParseNumber("8\u00a0892,6", true), 8892.6);
  EXPECT_EQ(ParseNumber("1\u202f234\u202f567"), 1234567);
  for (const char* text :
       {"8 892", "8 89.6", "8888'892", "'892", "8'8926", "8'", "0.5 123.4", "8''892", "1 2"}) {
    EXPECT_FALSE(ParseNumber(text)) << text;
  }
}

TEST(ParseNumberTest, LeavesNotANumberToTheCaller) {
  ASSERT_TRUE(ParseNumber("nan"));
  EXPECT_TRUE(std::isnan(*ParseNumber("nan")));
  EXPECT_TRUE(std::isinf(*ParseNumber("-inf")));
}

TEST(ParseNumberTest, DoesNotDependOnTheLocale) {
  const char* german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  EXPECT_EQ(ParseNumber("1.5"), 1.5);
  EXPECT_FALSE(ParseNumber("1,5"));
  if (german != nullptr) std::setlocale(LC_NUMERIC, "C");
}

TEST(QuotedTest, ShortensAndReplacesControlCharacters) {
  EXPECT_EQ(Quoted("abc"), "'abc'");
  EXPECT_EQ(Quoted("a\tb\x01"), "'a b '");
  EXPECT_EQ(Quoted(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(QuotedTest, NeverCutsThroughACharacter) {
  const std::string text = std::string(39, 'x') + "\u00b5\u00b5";
  EXPECT_EQ(Quoted(text), "'" + std::string(39, 'x') + "...'");
}

TEST(FirstInvalidUtf8Test, AcceptsEveryWellFormedLength) {
  for (const char* text : {"", "plain text, longer than eight", "\u00b5", "\u2212", "\U0001F426",
                           "12345678\u00b0C", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_FALSE(FirstInvalidUtf8(text)) << text;
  }
}

TEST(FirstInvalidUtf8Test, FindsTheFirstBadByte) {
  const struct {
    std::string text;
    std::size_t at;
  } kCases[] = {{"\xb0", 0},
                {"12345678ab\xb5", 10},
                {"a\xc3", 1},
                {"\xc0\xaf", 0},
                {"\xe0\x80\x80", 0},
                {"\xed\xa0\x80", 0},
                {"\xf5\x80\x80\x80", 0},
                {"ab\xe2\x88x", 2}};
  for (const auto& c : kCases) EXPECT_EQ(FirstInvalidUtf8(c.text), c.at);
}

TEST(HalfUnit, FollowsTheLastPrintedDigit) {
  EXPECT_DOUBLE_EQ(HalfUnit("1.23"), 0.005);
  EXPECT_DOUBLE_EQ(HalfUnit("9.82485E-04"), 0.5e-9);
  EXPECT_DOUBLE_EQ(HalfUnit("0.0010078"), 0.5e-7);
  EXPECT_DOUBLE_EQ(HalfUnit("100000"), 0.5);
}

}  // namespace
}  // namespace lyrefit
