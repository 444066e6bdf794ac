#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include "error_of.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/new_file.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

constexpr std::uintmax_t kShortFile = 1000;

int FilesIn(const std::string& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

TEST(WriteTextFileTest, WritesAndReplacesAndLeavesNothingElse) {
  const TempFolder folder;
  const std::string path = folder.Path("a.txt");
  ASSERT_TRUE(WriteTextFile(path, "one"));
  ASSERT_TRUE(WriteTextFile(path, "two"));
  EXPECT_EQ(*ReadTextFile(path, kShortFile), "two");
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
  EXPECT_EQ(*ReadTextFile(path, kShortFile), "new");
  EXPECT_EQ(std::filesystem::status(path).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(WriteTextFileTest, WritesStraightIntoDevices) {
  EXPECT_TRUE(WriteTextFile("/dev/null", "text"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteTextFileTest, LeavesTheOldFileAloneWhenTheDeviceIsFull) {
  EXPECT_THAT(MessageOf(WriteTextFile("/dev/full", "text")), HasSubstr("cannot write the file"));
}

TEST(WriteTextFileTest, RefusesFoldersAndFoldersThatDoNotExist) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf(WriteTextFile(folder.Path(""), "text")), HasSubstr("found a folder"));
  const std::string path = folder.Path("missing/a.txt");
  const auto nowhere = WriteTextFile(path, "text");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().file, path);
  EXPECT_THAT(nowhere.error().message, HasSubstr("cannot write into the folder"));
  // Nobody can write into /proc, not even root.
  EXPECT_FALSE(WriteTextFile("/proc/lyrefit.txt", "text"));
}

// A process that is killed at any moment while it writes leaves complete files only.
TEST(WriteTextFileTest, AKilledProcessLeavesNoPartOfAFile) {
  const TempFolder folder;
  const int nameless = open(folder.Path("").c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (nameless < 0) GTEST_SKIP() << "this file system has no files without names";
  close(nameless);
  const std::string text(4 << 20, 'x');
  for (int turn = 0; turn < 12; ++turn) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = 0;; ++i) {
        const std::string name = std::to_string(turn) + "-" + std::to_string(i) + ".txt";
        if (!WriteTextFile(folder.Path(name), text)) _exit(1);
      }
    }
    // Waits until some files exist, so that the kill interrupts the next one.
    while (FilesIn(folder.Path("")) <= turn % 3) std::this_thread::yield();
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    for (const auto& entry : fs::directory_iterator(folder.Path(""))) {
      EXPECT_EQ(entry.path().extension(), ".txt") << entry.path();
      EXPECT_EQ(entry.file_size(), text.size()) << entry.path();
      fs::remove(entry.path());
    }
  }
}

TEST(WriteTextFileTest, ALimitOfTheFileSizeIsAnErrorAndTheOldFileStays) {
  const TempFolder folder;
  const std::string path = folder.Write("a.txt", "old");
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 1 << 16;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto written = WriteTextFile(path, std::string(1 << 20, 'x'));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("cannot write the file: File too large"));
  EXPECT_EQ(*ReadTextFile(path, kShortFile), "old");
  EXPECT_EQ(FilesIn(folder.Path("")), 1);
}

TEST(WriteTextFileTest, RemovesWhatDeadProcessesLeftOfTheSameFileOnly) {
  const TempFolder folder;
  const pid_t dead = fork();
  if (dead == 0) _exit(0);
  int status = 0;
  waitpid(dead, &status, 0);
  const auto leave = [&](const std::string& name, int age_s) {
    const std::string path = folder.Write(name, "part");
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::seconds(age_s));
  };
  const std::string id = std::to_string(dead);
  leave("a.txt." + id + "-0.tmp", 3600);
  leave("a.txt." + id + "-17.tmp", 3600);
  const std::string kept[] = {
      "a.txt." + id + "-1.tmp",                         // too young
      "a.txt." + std::to_string(getpid()) + "-9.tmp",   // its process is alive
      "b.txt." + id + "-0.tmp",                         // belongs to another file
      "a.txt." + id + ".tmp", "a.txt." + id + "-0.csv"  // other name patterns
  };
  for (const std::string& name : kept) leave(name, name == kept[0] ? 0 : 3600);
  ASSERT_TRUE(WriteTextFile(folder.Path("a.txt"), "new"));
  for (const std::string& name : kept) EXPECT_TRUE(fs::exists(folder.Path(name))) << name;
  EXPECT_EQ(FilesIn(folder.Path("")), 6);
}

TEST(CheckWritableTest, SaysWhetherAFileCanBeWrittenAndLeavesNone) {
  const TempFolder folder;
  folder.Write("old.txt", "old");
  EXPECT_TRUE(CheckWritable(folder.Path("old.txt")));
  EXPECT_TRUE(CheckWritable(folder.Path("new.txt")));
  EXPECT_TRUE(CheckWritable("/dev/null"));
  EXPECT_EQ(MessageOf(CheckWritable(folder.Path(""))), "expected a file to write, found a folder");
  EXPECT_EQ(MessageOf(CheckWritable(folder.Path("no/new.txt"))),
            "cannot write the file: No such file or directory");
  EXPECT_EQ(*ReadTextFile(folder.Path("old.txt"), kShortFile), "old");
  EXPECT_EQ(FilesIn(folder.Path("")), 1);
}

TEST(NewFileTest, HasItsNameAfterCommitOnly) {
  const TempFolder folder;
  const std::string path = folder.Write("a.txt", "old"), other = folder.Path("b.txt");
  {
    NewFile file(path);
    ASSERT_TRUE(file.Begin());
    ASSERT_TRUE(file.Write(std::string(1 << 20, 'x')));
  }
  EXPECT_EQ(*ReadTextFile(path, kShortFile), "old");
  EXPECT_EQ(FilesIn(folder.Path("")), 1);
  NewFile first(path), second(other);
  ASSERT_TRUE(first.Begin());
  ASSERT_TRUE(second.Begin());
  ASSERT_TRUE(first.Write("one, "));
  ASSERT_TRUE(first.Write("two"));
  ASSERT_TRUE(NewFile::Commit({&first, &second}));
  EXPECT_EQ(*ReadTextFile(path, kShortFile), "one, two");
  EXPECT_EQ(*ReadFileBytes(other, kShortFile), "");
  EXPECT_EQ(FilesIn(folder.Path("")), 2);
}

TEST(WriteTextFileTest, ReplacesInSharedMemoryToo) {
  const std::string path = "/dev/shm/lyrefit-test-" + std::to_string(getpid());
  if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "no /dev/shm";
  ASSERT_TRUE(WriteTextFile(path, "one"));
  ASSERT_TRUE(WriteTextFile(path, "two"));
  EXPECT_EQ(*ReadTextFile(path, kShortFile), "two");
  fs::remove(path);
}

}  // namespace
}  // namespace lyrefit
