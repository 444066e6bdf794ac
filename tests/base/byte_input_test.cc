#include "lyrefit/base/byte_input.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <thread>

#include "lyrefit/base/file.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

constexpr std::uintmax_t kMostBytes = 1 << 20;

TEST(ByteInput, ReadsAPipeToItsEndHoweverItComes) {
  const TempFolder folder;
  const std::string path = folder.Path("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_TRUE(IsStream(path));
  EXPECT_FALSE(IsStream(folder.Write("file", "x")));
  EXPECT_FALSE(IsStream(folder.Path("nothing")));
  std::thread writer([&] {
    std::ofstream pipe(path);  // blocks until the reader opens it
    for (int i = 0; i < 1000; ++i) pipe << i << "\n" << std::flush;
  });
  const auto text = ReadFileBytes(path, kMostBytes);
  writer.join();
  ASSERT_TRUE(text) << text.error().ToString();
  EXPECT_EQ(text->size(), 10 * 2 + 90 * 3 + 900 * 4U);
}

TEST(StoppableReads, EndTheWaitingForAPipe) {
  const TempFolder folder;
  const std::string path = folder.Path("pipe");  // no process writes into it
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  int asked = 0;
  const StoppableReads outer(StopToken([&asked] { return ++asked > 3; }));
  const StoppableReads inner(StopToken([] { return false; }));
  const auto text = ReadFileBytes(path, kMostBytes);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().message, "stopped before the end of it was read");
  EXPECT_EQ(asked, 4);
}

TEST(StoppableReads, EndTheReadingOfAFileAndGoWithTheirLife) {
  const TempFolder folder;
  const std::string path = folder.Write("file", std::string(1 << 18, 'x'));
  {
    int asked = 0;
    const StoppableReads reads(StopToken([&asked] { return ++asked > 2; }));
    EXPECT_FALSE(ReadFileBytes(path, kMostBytes));
    EXPECT_EQ(asked, 3) << "of more blocks";
  }
  EXPECT_TRUE(ReadFileBytes(path, kMostBytes));
}

TEST(StoppableReads, AreOfOneThread) {
  const StoppableReads reads(StopToken([] { return true; }));
  EXPECT_TRUE(StoppableReads::Stopped());
  std::thread([] { EXPECT_FALSE(StoppableReads::Stopped()); }).join();
}

}  // namespace
}  // namespace lyrefit
