#include <gtest/gtest.h>

#include "lyrefit/report/document.h"
#include "lyrefit/report/markdown.h"
#include "sample_document.h"

namespace lyrefit {
namespace {

TEST(DrawMarkdown, ShowsNamesAsTheyAre) {
  EXPECT_EQ(DrawMarkdown(HostileDocument()),
            R"(> **DOUBTFUL: is \<b\>this\</b\> a \*curve\*?**

# report of \</title\>\<script\>alert("1 \& 2")\</script\>

- **curve**: a\_b\_c.csv \& 'others'
- and one more

## 1. Results | \<i\>of\</i\> all

- **size**: 3 V

| name | RMSE A | \`why\` |
|---|---:|---|
| \<td\>\|\</td\> | 1 | first |
| second line |  |  |

\# 1 of 2 \[links\](http://x) at \$3 \~ \\ 4 )"
            "\x01"
            R"(

- \- one
- 2\. two

    a   <b>

*current \& voltage*

**all \< well**

### below

deeper
)");
}

TEST(DrawMarkdown, LeavesNumbersAlone) {
  Document document;
  AddSections({{"", {block::Sentence{"2.5 A"}, block::Sentence{"-3 V"}}}}, &document);
  EXPECT_EQ(DrawMarkdown(document), "2.5 A\n\n-3 V\n");
  EXPECT_EQ(DrawMarkdown({}), "");
}

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
