#include "paper/page_blocks.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(ReplaceBlock, ReplacesBetweenTheMarksAndNothingElse) {
  const std::string page = "one\n<!-- x -->\nold\n<!-- end of x -->\ntwo\n";
  EXPECT_EQ(ReplaceBlock(page, "x", "new\n"), "one\n<!-- x -->\nnew\n<!-- end of x -->\ntwo\n");
  EXPECT_EQ(ReplaceBlock(page, "y", "new\n"), page);
  const std::string open = "<!-- x -->\nold\n";
  EXPECT_EQ(ReplaceBlock(open, "x", "new\n"), open);
}

}  // namespace
}  // namespace lyrefit
