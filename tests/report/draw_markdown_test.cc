#include <gtest/gtest.h>

#include "lyrefit/report/document.h"
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

}  // namespace
}  // namespace lyrefit
