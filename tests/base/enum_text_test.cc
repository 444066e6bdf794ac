#include "lyrefit/base/enum_text.h"

#include <gtest/gtest.h>

namespace lyrefit {

enum class Bird { kLyrebird, kEmu };

template <>
struct EnumTable<Bird> {
  static constexpr EnumText<Bird> kRows[] = {{Bird::kLyrebird, "lyrebird"}, {Bird::kEmu, "emu"}};
};

namespace {

TEST(EnumTextTest, TextAndValueGoBothWays) {
  for (const auto& row : EnumTable<Bird>::kRows) {
    EXPECT_EQ(ToText(row.value), row.text);
    EXPECT_EQ(FromText<Bird>(row.text), row.value);
  }
}

TEST(EnumTextTest, UnknownTextIsNoValue) {
  EXPECT_FALSE(FromText<Bird>("Emu"));
  EXPECT_FALSE(FromText<Bird>(""));
}

TEST(EnumTextTest, ValueOutsideTheTableIsAQuestionMark) {
  EXPECT_EQ(ToText(static_cast<Bird>(99)), "?");
}

TEST(EnumTextTest, ListsAllTextsInOrder) { EXPECT_EQ(AllTexts<Bird>(), "lyrebird, emu"); }

}  // namespace
}  // namespace lyrefit
