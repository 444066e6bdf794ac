#include "lyrefit/report/document.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

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
