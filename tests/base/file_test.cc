#include "lyrefit/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "../temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr std::uintmax_t kLimit = 1000;

int FilesIn(const std::string& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

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
  const auto text = ReadTextFile(folder.Write("b.txt", std::string(kLimit + 1, 'x')), kLimit);
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, HasSubstr("larger than the limit of 1000 bytes"));
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

TEST(WriteTextFileTest, WritesAndReplacesAndLeavesNothingElse) {
  const TempFolder folder;
  const std::string path = folder.Path("a.txt");
  ASSERT_TRUE(WriteTextFile(path, "one"));
  ASSERT_TRUE(WriteTextFile(path, "two"));
  EXPECT_EQ(*ReadTextFile(path, kLimit), "two");
  EXPECT_EQ(FilesIn(folder.Path("")), 1);
}

TEST(WriteTextFileTest, KeepsPermissionsAndSymbolicLinks) {
  const TempFolder folder;
  const std::string path = folder.Write("a.txt", "old");
  std::filesystem::permissions(
      path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::create_symlink(path, folder.Path("link.txt"));
  ASSERT_TRUE(WriteTextFile(folder.Path("link.txt"), "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.Path("link.txt")));
  EXPECT_EQ(*ReadTextFile(path, kLimit), "new");
  EXPECT_EQ(std::filesystem::status(path).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(WriteTextFileTest, WritesStraightIntoDevices) {
  EXPECT_TRUE(WriteTextFile("/dev/null", "text"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteTextFileTest, LeavesTheOldFileAloneWhenTheDeviceIsFull) {
  const auto written = WriteTextFile("/dev/full", "text");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("cannot write the file"));
}

TEST(WriteTextFileTest, RefusesFoldersAndFoldersThatDoNotExist) {
  const TempFolder folder;
  const auto into_folder = WriteTextFile(folder.Path(""), "text");
  ASSERT_FALSE(into_folder);
  EXPECT_THAT(into_folder.error().message, HasSubstr("found a folder"));
  const std::string path = folder.Path("missing/a.txt");
  const auto nowhere = WriteTextFile(path, "text");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().file, path);
  EXPECT_THAT(nowhere.error().message, HasSubstr("cannot write into the folder"));
  // A folder that nobody may write into, not even root.
  EXPECT_FALSE(WriteTextFile("/proc/lyrefit.txt", "text"));
}

}  // namespace
}  // namespace lyrefit
