#include "lyrefit/report/markdown.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(MarkdownTable, HasHeadRulerAndPaddedRows) {
  MarkdownTable table("lr");
  table.Add({"name", "value"});
  table.Add({"a|b", "1"});
  table.Add({"short"});
  EXPECT_EQ(table.Text(), "| name | value |\n|---|---:|\n| a\\|b | 1 |\n| short |  |\n\n");
}

TEST(MarkdownTable, IsNothingWithoutRows) { EXPECT_EQ(MarkdownTable("l").Text(), ""); }

TEST(ReplaceBlock, ReplacesBetweenTheMarksAndNothingElse) {
  const std::string page = "one\n<!-- x -->\nold\n<!-- end of x -->\ntwo\n";
  EXPECT_EQ(ReplaceBlock(page, "x", "new\n"), "one\n<!-- x -->\nnew\n<!-- end of x -->\ntwo\n");
  EXPECT_EQ(ReplaceBlock(page, "y", "new\n"), page);
  const std::string open = "<!-- x -->\nold\n";
  EXPECT_EQ(ReplaceBlock(open, "x", "new\n"), open);
}

}  // namespace
}  // namespace lyrefit
