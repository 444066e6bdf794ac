#include "lyrefit/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr std::uintmax_t kLimit = 1000;

TEST(ReadTextFileTest, ReturnsTheWholeText) {
  const TempFolder folder;
  const auto text = ReadTextFile(folder.Write("a.txt", "one\r\ntwo\n"), kLimit);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "one\r\ntwo\n");
}

TEST(ReadTextFileTest, StripsTheByteOrderMark) {
  const TempFolder folder;
  const auto text = ReadTextFile(folder.Write("a.txt", "\xef\xbb\xbfone"), kLimit);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "one");
}

TEST(ReadTextFileTest, TakesExactlyTheLimitAndRefusesOneByteMore) {
  const TempFolder folder;
  EXPECT_TRUE(ReadTextFile(folder.Write("a.txt", std::string(kLimit, 'x')), kLimit));
  EXPECT_THAT(MessageOf(ReadTextFile(folder.Write("b.txt", std::string(kLimit + 1, 'x')), kLimit)),
              HasSubstr("larger than the limit of 1000 bytes"));
}

TEST(ReadTextFileTest, RefusesWhatIsNoTextFileAndNamesIt) {
  const TempFolder folder;
  const struct {
    std::string path;
    const char* phrase;
  } kCases[] = {
      {folder.Path("missing.txt"), "does not exist"},
      {folder.Path(""), "found a folder"},
      {folder.Write("empty.txt", ""), "empty"},
      {folder.Write("bom.txt", "\xef\xbb\xbf"), "empty"},
      {folder.Write("binary.dat", std::string("a\0b", 3)), "binary"},
      {folder.Write("utf16.txt", std::string("\xff\xfe\x31\0", 4)), "UTF-16"},
      {"/dev/zero", "larger than the limit"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.path);
    const auto text = ReadTextFile(c.path, kLimit);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().file, c.path);
    EXPECT_THAT(text.error().message, HasSubstr(c.phrase));
  }
}

}  // namespace
}  // namespace lyrefit
