#include "lyrefit/read/table_lines.h"

#include <gtest/gtest.h>

#include <vector>

namespace lyrefit {
namespace {

std::vector<std::string> Split(char delimiter, std::string_view line) {
  LineSplitter splitter(delimiter);
  EXPECT_TRUE(splitter.Split(line));
  std::vector<std::string> fields;
  for (std::size_t i = 0; i < splitter.size(); ++i) fields.emplace_back(splitter[i]);
  return fields;
}

using Fields = std::vector<std::string>;

TEST(LineReaderTest, CountsLinesWithAnyEnd) {
  for (const char* text : {"a\n\nb\n", "a\r\n\r\nb", "a\r\rb\r"}) {
    LineReader lines(text);
    std::string_view line;
    ASSERT_TRUE(lines.Next(&line));
    EXPECT_EQ(line, "a");
    ASSERT_TRUE(lines.Next(&line));
    EXPECT_EQ(line, "");
    ASSERT_TRUE(lines.Next(&line));
    EXPECT_EQ(line, "b");
    EXPECT_EQ(lines.number(), 3);
    EXPECT_FALSE(lines.Next(&line));
  }
}

TEST(LineReaderTest, ContentIsNeitherBlankNorComment) {
  LineReader lines("# c\n \t\n  # d\n 1\n");
  std::string_view line;
  ASSERT_TRUE(lines.NextContent(&line));
  EXPECT_EQ(line, " 1");
  EXPECT_EQ(lines.number(), 4);
  EXPECT_FALSE(lines.NextContent(&line));
}

TEST(LineReaderTest, RulesBetweenHeadAndRowsAreNoContent) {
  LineReader lines("|---|:-:|\n----+----\n====\n-1 | 2\n--\n");
  std::string_view line;
  ASSERT_TRUE(lines.NextContent(&line));
  EXPECT_EQ(line, "-1 | 2");
  ASSERT_TRUE(lines.NextContent(&line));
  EXPECT_EQ(line, "--");  // a missing reading, perhaps
}

TEST(LineReaderTest, GoesOnFromAnOffset) {
  const std::string text = "one\ntwo\nthree";
  LineReader lines(text, 4, 1);
  std::string_view line;
  ASSERT_TRUE(lines.Next(&line));
  EXPECT_EQ(line, "two");
  EXPECT_EQ(lines.number(), 2);
}

TEST(LineSplitterTest, SplitsAtTheDelimiterAndTrims) {
  EXPECT_EQ(Split(',', "1, 2 ,3"), (Fields{"1", "2", "3"}));
  EXPECT_EQ(Split(';', "1,5;2"), (Fields{"1,5", "2"}));
  EXPECT_EQ(Split('\t', "1\t 2"), (Fields{"1", "2"}));
  EXPECT_EQ(Split(' ', "  1   2\t3 "), (Fields{"1", "2", "3"}));
}

TEST(LineSplitterTest, KeepsEmptyFieldsExceptBetweenBlanks) {
  EXPECT_EQ(Split(',', "1,,2,"), (Fields{"1", "", "2", ""}));
  EXPECT_EQ(Split(',', ","), (Fields{"", ""}));
}

TEST(LineSplitterTest, UnderstandsQuotes) {
  EXPECT_EQ(Split(',', R"("a, b","c ""d""")"), (Fields{"a, b", "c \"d\""}));
}

TEST(LineSplitterTest, RefusesOpenQuotesAndStillWorksAfterwards) {
  for (const char delimiter : {',', ' '}) {
    LineSplitter splitter(delimiter);
    EXPECT_FALSE(splitter.Split("\"open"));
    EXPECT_FALSE(splitter.Split("a\"b"));
    ASSERT_TRUE(splitter.Split(delimiter == ',' ? "1,2" : "1  2"));
    ASSERT_EQ(splitter.size(), 2U);
    EXPECT_EQ(splitter[1], "2");
  }
}

TEST(FieldColumnTest, PointsAtTheFirstCharacterOfTheField) {
  EXPECT_EQ(FieldColumn("0.1,abc", ',', 0), 1);
  EXPECT_EQ(FieldColumn("0.1,abc", ',', 1), 5);
  EXPECT_EQ(FieldColumn("0.1,  abc", ',', 1), 7);
  EXPECT_EQ(FieldColumn("  0.1   abc", ' ', 0), 3);
  EXPECT_EQ(FieldColumn("  0.1   abc", ' ', 1), 9);
  EXPECT_EQ(FieldColumn("0.1\t\tx", '\t', 2), 6);
  EXPECT_EQ(FieldColumn("\"a,b\",x", ',', 1), 7);
  EXPECT_EQ(FieldColumn("0.1,", ',', 1), 5);
}

}  // namespace
}  // namespace lyrefit
