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
  section.blocks.push_back(block::Preformatted{"a   b\n"});
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

std::string Drawn(block::Any block) { return DrawText({{}, {"", {std::move(block)}}}); }

TEST(DrawText, AlignsColumnsByTheirWidestCell) {
  EXPECT_EQ(Drawn(block::Table{"lr", {{"name", "value"}}, {{"\u00b5", "1"}, {"alone"}}}),
            "  name   value\n  \u00b5          1\n  alone\n");
}

TEST(DrawText, WrapsALastColumnOfLongTexts) {
  const std::string word(80, 'x');
  EXPECT_EQ(Drawn(block::Table{"rw", {{"RMSE", "what"}}, {{"1", word + " " + word}, {"2"}}}),
            "  RMSE  what\n     1  " + word + "\n        " + word + "\n     2\n");
}

TEST(DrawText, SetsTablesWithACaptionApart) {
  EXPECT_EQ(Drawn(block::Table{"lr", {{"", "A"}}, {{"x", "1"}}, "Currents"}),
            "\n  Currents\n     A\n  x  1\n");
}

TEST(DrawText, IndentsTheNamesBelowALineAcrossTheTable) {
  const std::string word(60, 'x');
  EXPECT_EQ(Drawn(block::Table{"lr",
                               {{"name", "A"}},
                               {{"x", "1"}, {"y", "2"}, {"z", "3"}},
                               "",
                               {{0, "first"}, {2, word + " " + word}}}),
            "    name  A\n"
            "  first\n"
            "    x     1\n"
            "    y     2\n"
            "  " +
                word + "\n  " + word + "\n" + "    z     3\n");
}

TEST(DrawText, SaysWhatBelongsToATitleBelowIt) {
  EXPECT_EQ(Drawn(block::Entry{"Ranks", {"a 1, b 2", "c 3"}}), "  Ranks\n    a 1, b 2\n    c 3\n");
  EXPECT_EQ(Drawn(block::Entry{"Ranks"}), "  Ranks\n");
}

TEST(DrawText, PutsLegendsAtTheEdgeAndMarksWarnings) {
  EXPECT_EQ(Drawn(block::Legend{"Columns are budgets."}), "Columns are budgets.\n");
  EXPECT_EQ(Drawn(block::Warning{"Look twice."}), "  ! Look twice.\n");
}

TEST(DrawText, WrapsAHeadingThatIsTooLongAndKeepsTheBlanksOfOthers) {
  const std::string word(60, 'x');
  Document document;
  AddSections(
      {{"RMSE   (all)", {block::Sentence{"a"}}}, {word + "  " + word, {block::Sentence{"b"}}}},
      &document);
  EXPECT_EQ(DrawText(document), "RMSE   (all)\n  a\n\n" + word + "\n" + word + "\n  b\n");
}

TEST(DrawText, BeginsWithTheFirstSectionWhereThereIsNoHead) {
  Document document;
  AddSections({{"", {block::Sentence{"alone"}}}}, &document);
  EXPECT_EQ(DrawText(document), "  alone\n");
  EXPECT_EQ(DrawText({}), "");
}

TEST(AddSections, LeavesOutWhatHasNothingToSay) {
  Document document;
  AddSections({{"full", {block::Sentence{"a"}}},
               {"empty"},
               ListSection("no list", {}),
               ListSection("list", {"b"})},
              &document);
  ASSERT_EQ(document.sections.size(), 2U);
  EXPECT_EQ(document.sections[0].heading, "full");
  EXPECT_EQ(document.sections[1].heading, "list");
}

TEST(AddField, KeepsTheOrderInWhichThingsAreSaid) {
  Section section;
  AddField("name", "text", &section);
  AddSentence("sentence", &section);
  AddTable({"l", {{"head"}}}, &section);
  AddList({}, &section);
  ASSERT_EQ(section.blocks.size(), 3U);
  EXPECT_EQ(std::get<block::Field>(section.blocks[0]).text, "text");
  EXPECT_EQ(std::get<block::Sentence>(section.blocks[1]).text, "sentence");
  EXPECT_EQ(std::get<block::Table>(section.blocks[2]).heads.size(), 1U);
}

}  // namespace
}  // namespace lyrefit
