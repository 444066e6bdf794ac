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

*of \<a\>*

|  | A |
|---|---:|
| **\*first\*** |  |
| x | 1 |
| **\& last** |  |
| y | 2 |

\* \<star\>

> \<!

- **a\_b \& c**
  - x \< y
  - \- z
- **alone**

````text
a   <b>
```
````

![seen "there"](a.svg)

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

TEST(DrawMarkdown, LeavesMarkdownAsItIsAndBreaksItsParagraphs) {
  const std::string word(60, 'x');
  Document document;
  document.head = {"`a`", {block::Sentence{"**b** " + word + " " + word}}};
  AddTable({"lr", {{"name", "A"}}, {{"a|b", "**1**"}, {"short"}}}, &document.head);
  EXPECT_EQ(DrawMarkdown(document, Texts::kMarkdown),
            "# `a`\n\n**b** " + word + "\n" + word +
                "\n\n| name | A |\n|---|---:|\n| a\\|b | **1** |\n| short |  |\n");
}

}  // namespace
}  // namespace lyrefit
