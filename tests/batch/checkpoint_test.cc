#include "lyrefit/batch/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "../error_of.h"
#include "../file_limit.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// Two shards of a run; the tests change the checkpoint of the second.
class ChangedPart : public testing::Test {
 protected:
  void SetUp() override {
    for (int k = 1; k <= 2; ++k) {
      BatchOptions options = Into(folder_.Path("shards"));
      options.shard = {k, 2};
      ASSERT_TRUE(RunOn(file_, CountTask(), options));
    }
    std::ifstream part(part_, std::ios::binary);
    for (std::string line; std::getline(part, line);) lines_.push_back(line);
    ASSERT_GT(lines_.size(), 15U);
  }

  void Write(const std::vector<std::string>& lines) const {
    std::ofstream part(part_, std::ios::binary);
    for (const std::string& line : lines) part << line << '\n';
  }

  Expected<BatchSummary> Merge() const {
    return MergeShards({folder_.Path("shards")}, {folder_.Path("out"), false});
  }
  Expected<BatchSummary> Resume() const {
    BatchOptions options = Into(folder_.Path("shards"));
    options.shard = {2, 2};
    options.start = BatchStart::kResume;
    return RunOn(file_, CountTask(), options);
  }

  // Merging and resuming both fail with the number of the changed line, from 1.
  void ExpectSeen(const std::vector<std::string>& lines, int line) const {
    Write(lines);
    ExpectErrorAt(Merge(), part_, line, 0, "the checksum of this line is not that of");
    EXPECT_FALSE(std::filesystem::exists(folder_.Path("out") + "/results.csv"));
    ExpectErrorAt(Resume(), part_, line, 0, "the checksum of this line is not that of");
  }

  const TempFolder folder_;
  const std::string file_ = folder_.Write("strings.jsonl", ManyRows(40));
  const std::string part_ = folder_.Path("shards") + "/shard-2-of-2.part";
  std::vector<std::string> lines_;
};

TEST_F(ChangedPart, IsSeenWhateverWasChanged) {
  ASSERT_TRUE(Resume()) << "as it is it is fine";
  int digits = 0;
  for (std::size_t at = 0; at < lines_[5].size(); ++at) {
    if (std::isdigit(static_cast<unsigned char>(lines_[5][at])) == 0) continue;
    std::vector<std::string> changed = lines_;
    char& digit = changed[5][at];
    digit = digit == '9' ? '1' : static_cast<char>(digit + 1);
    ExpectSeen(changed, 6);
    ++digits;
  }
  EXPECT_GT(digits, 100);
}

TEST_F(ChangedPart, IsSeenWhereRowsWereMovedLostOrRepeated) {
  for (std::size_t i = 1; i + 3 < lines_.size(); ++i) {
    std::vector<std::string> changed = lines_;
    std::swap(changed[i], changed[i + 1]);
    ExpectSeen(changed, static_cast<int>(i) + 1);
    changed = lines_;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
    ExpectSeen(changed, static_cast<int>(i) + 1);
    changed = lines_;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(i), lines_[i]);
    ExpectSeen(changed, static_cast<int>(i) + 2);
  }
}

TEST_F(ChangedPart, IsSeenInItsHeadAndEnd) {
  std::vector<std::string> changed = lines_;
  const std::size_t task = changed[0].find("\"how many\"");
  ASSERT_NE(task, std::string::npos);
  changed[0].replace(task, 10, "\"how much\"");
  Write(changed);
  ExpectErrorAt(Merge(), part_, 1, 0, "the checksum of this line");
  changed = lines_;
  changed.back().replace(changed.back().find("\"last\":[0,"), 10, "\"last\":[1,");
  Write(changed);
  ExpectErrorAt(Resume(), part_, static_cast<int>(lines_.size()), 0, "the checksum of this line");
}

TEST_F(ChangedPart, IsMergedAndGoneOnWithWhereNothingWas) {
  Write(lines_);
  const auto resumed = Resume();
  ASSERT_TRUE(resumed) << MessageOf(resumed);
  EXPECT_TRUE(resumed->was_complete);
  lines_.resize(lines_.size() - 5);
  Write(lines_);
  ASSERT_TRUE(Resume());
  const auto merged = Merge();
  ASSERT_TRUE(merged) << MessageOf(merged);
  ASSERT_TRUE(RunOn(file_, CountTask(), Into(folder_.Path("whole"))));
  EXPECT_EQ(ResultsIn(folder_.Path("out")), ResultsIn(folder_.Path("whole")));
}

TEST_F(ChangedPart, SaysWhatCannotBeWritten) {
  lines_.resize(lines_.size() - 5);
  Write(lines_);
  const std::string before = FileText(part_);
  {
    const FileLimit limit(before.size() + 10);
    ExpectErrorAt(Resume(), part_, 0, 0, "cannot write the rows: File too large");
  }
  EXPECT_EQ(FileText(part_), before);
  EXPECT_TRUE(Resume());
}

TEST_F(ChangedPart, WithoutChecksumsSaysWhatToDo) {
  std::vector<std::string> old = lines_;
  for (std::string& line : old) line = line.substr(0, line.rfind(",\"crc\"")) + "}";
  old[0].replace(0, std::string("{\"lyrefit_batch\":2").size(), "{\"lyrefit_batch\":1");
  Write(old);
  for (const std::string& said : {MessageOf(Merge()), MessageOf(Resume())}) {
    EXPECT_THAT(said, HasSubstr("these rows have no checksums, as an older lyrefit wrote them"));
    EXPECT_THAT(said, HasSubstr("begin anew with batch --force"));
  }
}

}  // namespace
}  // namespace lyrefit
