#include "lyrefit/base/append_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <vector>

#include "../error_of.h"
#include "../file_limit.h"
#include "lyrefit/base/try.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr LogKind kDiary = {"diary", "this diary", "a diary", "dear", "no diary"};

class AppendLogTest : public testing::Test {
 protected:
  // The lines of the log, or the error why it cannot be resumed.
  Expected<std::vector<std::string>> TakeUp(bool* torn = nullptr) {
    auto log = AppendLog::Open(path_, kDiary);
    if (!log) return tl::unexpected(log.error());
    std::vector<std::string> lines;
    const auto taken = (*log)->TakeUp([&](const std::string& line, int number) -> Expected<void> {
      EXPECT_EQ(number, static_cast<int>(lines.size()) + 1);
      if (line == "bad") return Fail("a bad line", path_, number);
      lines.push_back(line);
      return {};
    });
    if (!taken) return tl::unexpected(taken.error());
    if (torn != nullptr) *torn = (*log)->torn();
    return lines;
  }

  const TempFolder folder_;
  const std::string path_ = folder_.Path("diary");
};

TEST_F(AppendLogTest, GoesOnWhereItEnded) {
  EXPECT_THAT(*TakeUp(), ElementsAre());
  {
    const auto log = AppendLog::Open(path_, kDiary);
    ASSERT_TRUE(log) << MessageOf(log);
    EXPECT_TRUE((*log)->empty());
    ASSERT_TRUE((*log)->Append("dear\none\n"));
    ASSERT_TRUE((*log)->Append("two\n"));
    EXPECT_FALSE((*log)->empty());
  }
  bool torn = true;
  EXPECT_THAT(*TakeUp(&torn), ElementsAre("dear", "one", "two"));
  EXPECT_FALSE(torn);
}

TEST_F(AppendLogTest, CutsALineThatWasNeverFinishedOnce) {
  folder_.Write("diary", "dear\none\ntw");
  bool torn = false;
  EXPECT_THAT(*TakeUp(&torn), ElementsAre("dear", "one"));
  EXPECT_TRUE(torn);
  EXPECT_EQ(FileText(path_), "dear\none\n");
  EXPECT_THAT(*TakeUp(&torn), ElementsAre("dear", "one"));
  EXPECT_FALSE(torn);
}

TEST_F(AppendLogTest, NeverTouchesAFileOfAnotherKind) {
  for (const char* text : {"V,I\n0,1\n", "V,I\n0", "x"}) {
    folder_.Write("diary", text);
    ExpectErrorAt(TakeUp(), path_, 1, 0, "no diary");
    EXPECT_EQ(FileText(path_), text);
  }
  folder_.Write("diary", "dear\nbad\nhal");
  ExpectErrorAt(TakeUp(), path_, 2, 0, "a bad line");
  EXPECT_EQ(FileText(path_), "dear\nbad\nhal");
  folder_.Write("diary", "de");  // first line of a log, cut short
  EXPECT_THAT(*TakeUp(), ElementsAre());
}

TEST_F(AppendLogTest, IsReadWithoutAnyChange) {
  folder_.Write("diary", "dear\none\ntw");
  auto reader = LogReader::Open(path_, kDiary);
  ASSERT_TRUE(reader);
  EXPECT_EQ(**reader->Next(), "dear");
  EXPECT_FALSE(reader->torn());
  EXPECT_EQ(**reader->Next(), "one");
  EXPECT_EQ(reader->line(), 2);
  EXPECT_FALSE(*reader->Next());
  EXPECT_TRUE(reader->torn());
  EXPECT_EQ(FileText(path_), "dear\none\ntw");
  EXPECT_EQ(MessageOf(LogReader::Open(folder_.Path("no"), kDiary)),
            "cannot read the diary: No such file or directory");
  reader = LogReader::Open(folder_.Path(""), kDiary);
  EXPECT_EQ(reader ? MessageOf(reader->Next()) : MessageOf(reader),
            "cannot read the diary: Is a directory");
}

TEST_F(AppendLogTest, HasALastLine) {
  const auto last = [&](const std::string& text) {
    folder_.Write("diary", text);
    return LastLine(path_, kDiary)->value_or("none");
  };
  EXPECT_EQ(last(""), "none");
  EXPECT_EQ(last("dear\none\ntw"), "none");
  EXPECT_EQ(last("dear\n"), "dear");
  const std::string longest(4096, 'x');
  EXPECT_EQ(last(longest + "\n"), longest);
  EXPECT_EQ(last("dear\n" + longest + "\n"), longest);
  EXPECT_EQ(last(longest + "x\n"), "none");
  EXPECT_EQ(last("dear\n" + longest + "x\n"), "none");
}

TEST_F(AppendLogTest, IsWrittenByOneAtATime) {
  const auto log = AppendLog::Open(path_, kDiary);
  ASSERT_TRUE(log);
  EXPECT_EQ(MessageOf(AppendLog::Open(path_, kDiary)), "another process is writing this diary");
}

TEST_F(AppendLogTest, SaysWhyItCannotBeWritten) {
  EXPECT_EQ(MessageOf(AppendLog::Open("/dev/full", kDiary)),
            "expected a diary, or a file that does not exist yet");
  EXPECT_EQ(MessageOf(AppendLog::Open(folder_.Path("no/diary"), kDiary)),
            "cannot write the diary: No such file or directory");
  const auto log = AppendLog::Open(path_, kDiary);
  ASSERT_TRUE(log);
  ASSERT_TRUE((*log)->Append("dear\n"));
  {
    const FileLimit limit(20);
    const auto written = (*log)->Append("a line of more than twenty bytes\n");
    EXPECT_EQ(MessageOf(written), "cannot write the diary: File too large");
    EXPECT_EQ(written.error().file, path_);
    EXPECT_EQ(FileText(path_), "dear\n") << "what could not be written whole is taken back";
  }
  ASSERT_TRUE((*log)->Append("once more\n"));
  EXPECT_EQ(FileText(path_), "dear\nonce more\n");
}

constexpr LogKind kLedger = {"ledger",      "this ledger", "a ledger",
                             "{\"ledger\"", "no ledger",   "begin another ledger"};

class SealedLogTest : public testing::Test {
 protected:
  void SetUp() override {
    Append("{\"ledger\":1}\n[1,2]\n{\"a\":\"b\"}\n");
    Append("[3]\n");
    whole_ = FileText(path_);
  }

  void Append(const std::string& lines) const {
    const auto log = AppendLog::Open(path_, kLedger);
    ASSERT_TRUE(log) << MessageOf(log);
    ASSERT_TRUE((*log)->TakeUp([](const std::string&, int) { return Expected<void>(); }));
    ASSERT_TRUE((*log)->Append(lines));
  }

  // The lines of a ledger with this text.
  Expected<std::vector<std::string>> LinesOf(const std::string& text) const {
    TRY(LogReader log, LogReader::Open(folder_.Write("ledger", text), kLedger));
    std::vector<std::string> lines;
    while (true) {
      TRY(const auto line, log.Next());
      if (!line) return lines;
      lines.push_back(*line);
    }
  }

  const TempFolder folder_;
  const std::string path_ = folder_.Path("ledger");
  std::string whole_;
};

TEST_F(SealedLogTest, GivesTheLinesWithoutTheirChecksums) {
  const auto lines = LinesOf(whole_);
  ASSERT_TRUE(lines) << MessageOf(lines);
  EXPECT_THAT(*lines, ElementsAre("{\"ledger\":1}", "[1,2]", "{\"a\":\"b\"}", "[3]"));
  EXPECT_THAT(whole_, testing::ContainsRegex("^.\"ledger\":1,\"crc\":\"[0-9a-f]{8}\".\n"));
  EXPECT_THAT(whole_, testing::ContainsRegex("\n.3,\"[0-9a-f]{8}\".\n$"));
}

TEST_F(SealedLogTest, SeesEveryByteThatWasChanged) {
  for (std::size_t i = 0; i < whole_.size(); ++i) {
    if (whole_[i] == '\n') continue;
    std::string changed = whole_;
    changed[i] = changed[i] == '7' ? '8' : '7';
    EXPECT_FALSE(LinesOf(changed)) << i;
  }
}

TEST_F(SealedLogTest, SeesLinesThatWereMovedLostOrRepeated) {
  const std::size_t second = whole_.find('\n') + 1, third = whole_.find('\n', second) + 1;
  const std::string row = whole_.substr(second, third - second);
  const std::string rest = whole_.substr(third);
  for (const std::string& text :
       {whole_.substr(0, second) + rest, whole_.substr(0, third) + row + rest,
        whole_.substr(0, second) + rest + row}) {
    EXPECT_THAT(MessageOf(LinesOf(text)),
                HasSubstr("a line was changed, moved or lost; begin another ledger"));
  }
}

TEST_F(SealedLogTest, LeavesOneThatWasBegunWithoutChecksumsWithoutThem) {
  folder_.Write("ledger", "{\"ledger\":1}\n[1]\n");
  Append("[2]\n");
  EXPECT_EQ(FileText(path_), "{\"ledger\":1}\n[1]\n[2]\n");
  ExpectErrorAt(LinesOf("{\"ledger\":1}\n[1,\"0123abcd\"]\n"), path_, 2, 0, "the checksum");
}

TEST_F(SealedLogTest, DoesNotWaitForThePipe) {
  const std::string pipe = folder_.Path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(MessageOf(LogReader::Open(pipe, kLedger)), HasSubstr("found a pipe or a device"));
}

}  // namespace
}  // namespace lyrefit
