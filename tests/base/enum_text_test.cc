#include "lyrefit/base/enum_text.h"

#include <gtest/gtest.h>

#include "lyrefit/base/setting_text.h"
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

TEST(SettingText, ReadsWhatItWrites) {
  const auto assignment = ReadAssignment("n2=2");
  ASSERT_TRUE(assignment);
  EXPECT_EQ(AssignmentText(assignment->first, assignment->second), "n2=2");
  const auto range = ReadRange("Rs=0:0.5");
  ASSERT_TRUE(range);
  EXPECT_EQ(RangeText(range->first, range->second), "Rs=0:0.5");
}

TEST(SettingText, SaysWhatItExpects) {
  for (const char* text : {"", "n2", "=2", "n2=", "n2=x", "n2=2=3"}) {
    const auto assignment = ReadAssignment(text);
    ASSERT_FALSE(assignment) << text;
    EXPECT_EQ(assignment.error().message,
              std::string("expected PARAMETER=VALUE such as n2=2, found '") + text + "'");
  }
  for (const char* text : {"", "Rs", "Rs=1", "Rs=1:", "=0:1", "Rs=0:1:2"}) {
    const auto range = ReadRange(text);
    ASSERT_FALSE(range) << text;
    EXPECT_EQ(range.error().message,
              std::string("expected PARAMETER=LOWER:UPPER such as Rs=0:0.5, found '") + text + "'");
  }
}

}  // namespace
}  // namespace lyrefit
