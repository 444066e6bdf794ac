#include "lyrefit/base/number_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <clocale>
#include <optional>
#include <string>

#include "cases.h"

namespace lyrefit {
namespace {

TEST(ParseNumberTest, ReadsEverySpellingAndRefusesTheRest) {
  const auto text_of = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "none";
  };
  CheckCases("base_numbers",
             {{"number", [&](const std::string& text) { return text_of(ParseNumber(text)); }},
              {"number or comma",
               [&](const std::string& text) { return text_of(ParseNumber(text, true)); }},
              {"half unit", [&](const std::string& text) { return text_of(HalfUnit(text)); }}});
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

}  // namespace
}  // namespace lyrefit
