#include "lyrefit/read/text_encoding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

std::string Utf16(const std::u16string& text, bool big) {
  std::string bytes;
  for (const char16_t unit : text) {
    const char low = static_cast<char>(unit & 0xff);
    const char high = static_cast<char>(unit >> 8);
    bytes += big ? high : low;
    bytes += big ? low : high;
  }
  return bytes;
}

TEST(DecodeTextTest, Utf8StaysAsItIs) {
  for (const std::string text : {"V,I\n0,1\n", "U [V];T [\u00b0C]\n"}) {
    const auto decoded = DecodeText(text, "");
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->text, text);
    EXPECT_EQ(decoded->remark, "");
    EXPECT_EQ(DecodeText("\xef\xbb\xbf" + text, "")->text, text);
  }
}

TEST(DecodeTextTest, Utf16OfEitherOrderWithAndWithoutMark) {
  const std::u16string text = u"T [\u00b0C],\U0001d11e\n25,1\n";
  const std::string expected = "T [\u00b0C],\U0001d11e\n25,1\n";
  for (const bool big : {false, true}) {
    for (const bool mark : {false, true}) {
      const auto decoded = DecodeText(Utf16((mark ? u"\ufeff" : u"") + text, big), "");
      ASSERT_TRUE(decoded) << big << mark;
      EXPECT_EQ(decoded->text, expected);
      EXPECT_THAT(decoded->remark, HasSubstr("UTF-16"));
    }
  }
}

TEST(DecodeTextTest, HalfSurrogatesAndHalfUnitsDoNotBreakIt) {
  const auto decoded = DecodeText(Utf16(u"\ufeffa\xd834", false) + "b", "");
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->text, "a\ufffd");
}

TEST(DecodeTextTest, EverythingElseIsWindows1252AndSaid) {
  const auto decoded = DecodeText(
      "Tc [\xb0"
      "C];\x80\n47;W/m\xb2\n",
      "");
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->text, "Tc [\u00b0C];\u20ac\n47;W/m\u00b2\n");
  EXPECT_EQ(decoded->remark, "the file is not UTF-8 (line 1): read as Windows-1252 (Latin-1)");
}

TEST(DecodeTextTest, RefusesWhatIsNoText) {
  const struct {
    std::string bytes;
    const char* phrase;
  } kCases[] = {
      {"", "empty"},
      {"\xef\xbb\xbf", "empty"},
      {"\xff\xfe", "empty"},
      {std::string("a\0b", 3), "binary"},
      {std::string("PK\x03\x04\x14\0", 6), "Excel workbook: save the sheet as CSV"},
  };
  for (const auto& c : kCases) {
    const auto decoded = DecodeText(c.bytes, "f");
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().file, "f");
    EXPECT_THAT(decoded.error().message, HasSubstr(c.phrase));
  }
}

}  // namespace
}  // namespace lyrefit
