#include "lyrefit/base/enum_text.h"

#include <gtest/gtest.h>

#include "lyrefit/search/search_options.h"

namespace lyrefit {

enum class Candidate { kLyrebird, kEmu };

template <>
struct EnumTable<Candidate> {
  static constexpr EnumText<Candidate> kRows[] = {{Candidate::kLyrebird, "lyrebird"},
                                                  {Candidate::kEmu, "emu"}};
};

namespace {

TEST(EnumTextTest, TextAndValueGoBothWays) {
  for (const auto& row : EnumTable<Candidate>::kRows) {
    EXPECT_EQ(ToText(row.value), row.text);
    EXPECT_EQ(FromText<Candidate>(row.text), row.value);
  }
}

TEST(EnumTextTest, UnknownTextIsNoValue) {
  EXPECT_FALSE(FromText<Candidate>("Emu"));
  EXPECT_FALSE(FromText<Candidate>(""));
}

TEST(EnumTextTest, ValueOutsideTheTableIsAQuestionMark) {
  EXPECT_EQ(ToText(static_cast<Candidate>(99)), "?");
}

TEST(EnumTextTest, ListsAllTextsInOrder) { EXPECT_EQ(AllTexts<Candidate>(), "lyrebird, emu"); }

TEST(EnumText, TakesTheSpellingOfTheFormerVersion) {
  EXPECT_EQ(FromText<Algorithm>("mlo+knees"), Algorithm::kMloShape);
  EXPECT_EQ(ToText(Algorithm::kMloShape), "mlo+shape");
}

}  // namespace
}  // namespace lyrefit
