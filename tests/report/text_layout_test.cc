#include "lyrefit/report/text_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lyrefit {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Significant, KeepsTrailingZerosAndSaysUnknown) {
  EXPECT_EQ(Significant(0.76078796, 6), "0.760788");
  EXPECT_EQ(Significant(0.76, 6), "0.760000");
  EXPECT_EQ(Significant(3.1068e-7, 6), "3.10680e-07");
  EXPECT_EQ(Significant(123456, 6), "123456");
  EXPECT_EQ(Significant(0, 6), "0");
  EXPECT_EQ(Significant(kNaN, 6), "-");
}

TEST(Range, ShowsEnoughDigitsToTellTheEndsApart) {
  EXPECT_EQ(Range(0.99991, 1.00009), "0.999910 .. 1.00009");
  EXPECT_EQ(Range(1, 2), "1.00 .. 2.00");
  EXPECT_EQ(Range(0, 3e-7), "0 .. 3.00e-07");
  EXPECT_EQ(Range(kNaN, 1), "-");
  EXPECT_EQ(Range(10, std::numeric_limits<double>::infinity()), "10.00 .. inf");
}

TEST(Duration, PicksTheUnit) {
  EXPECT_EQ(Duration(0.0123), "12.3 ms");
  EXPECT_EQ(Duration(12.345), "12.3 s");
  EXPECT_EQ(Duration(kNaN), "-");
}

TEST(Wrap, BreaksAtBlanksAndIndentsTheRest) {
  std::string words;
  for (int i = 0; i < 60; ++i) words += "word ";
  const std::string text = Wrap("  - ", words);
  std::size_t begin = 0;
  int lines = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth));
    EXPECT_EQ(line.substr(0, 8), lines == 0 ? "  - word" : "    word");
    ++lines;
  }
  EXPECT_EQ(lines, 4);
  EXPECT_EQ(begin, text.size());
}

TEST(Wrap, LeavesAWordLongerThanTheLineWhole) {
  const std::string word(150, 'x');
  EXPECT_EQ(Wrap("> ", word), "> " + word + "\n");
}

TEST(Columns, CountsLettersAndNotBytes) {
  EXPECT_EQ(Columns("1 \u00b5A"), 4U);
  EXPECT_EQ(Columns(""), 0U);
}

}  // namespace
}  // namespace lyrefit
