#include <gtest/gtest.h>

#include "lyrefit/report/document.h"

namespace lyrefit {
namespace {

TEST(DrawText, KeepsTheCustomsOfTheTerminal) {
  Document document;
  document.banners = {"INTERRUPTED: early."};
  document.head.heading = "title";
  AddField("curve", "a.csv", &document.head);
  AddField("", "b.csv", &document.head);
  Section section = {"Parameters"};
  AddTable({"lr", {{"", "value"}, {"name", "A"}}, {{"Rs", "1"}}}, &section);
  AddSentence("A sentence.", &section);
  AddList({"one", "two"}, &section);
  section.blocks.push_back(block::Preformatted{"a   b"});
  section.blocks.push_back(block::Figure{"seen elsewhere"});
  AddSections({section, {"", {block::Conclusion{"The end."}}}}, &document);
  EXPECT_EQ(DrawText(document),
            "INTERRUPTED: early.\n"
            "\n"
            "title\n"
            "  curve         a.csv\n"
            "                b.csv\n"
            "\n"
            "Parameters\n"
            "        value\n"
            "  name      A\n"
            "  Rs        1\n"
            "  A sentence.\n"
            "  - one\n"
            "  - two\n"
            "a   b\n"
            "\n"
            "The end.\n");
}

TEST(DrawText, BeginsWithTheFirstSectionWhereThereIsNoHead) {
  Document document;
  AddSections({{"", {block::Sentence{"alone"}}}}, &document);
  EXPECT_EQ(DrawText(document), "  alone\n");
  EXPECT_EQ(DrawText({}), "");
}

}  // namespace
}  // namespace lyrefit
