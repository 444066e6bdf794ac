#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "../error_of.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

class MergeTest : public testing::Test {
 protected:
  void Shard(int k, int of, const std::string& name = "shards", std::uint64_t seed = 0) {
    BatchOptions options = Into(folder_.Path(name));
    options.shard = {k, of};
    options.seed = seed;
    const auto done = RunOn(file_, CountTask(), options);
    ASSERT_TRUE(done) << done.error().ToString();
  }
  Expected<BatchSummary> Merge(const std::vector<std::string>& names, const std::string& out) {
    std::vector<std::string> folders;
    for (const std::string& name : names) folders.push_back(folder_.Path(name));
    return MergeShards(folders, {folder_.Path(out), false});
  }

  const TempFolder folder_;
  std::string file_ = folder_.Write("strings.jsonl", ManyRows(100));
};

TEST_F(MergeTest, OfAnyNumberOfShardsGivesTheBytesOfOneRun) {
  ASSERT_TRUE(RunOn(file_, CountTask(), Into(folder_.Path("whole"))));
  for (const int of : {2, 3, 8}) {
    const std::string name = "shards" + std::to_string(of);
    for (int k = of; k >= 1; --k) Shard(k, of, k % 2 == 0 ? name : name + "b");
    const auto merged = Merge({name, name + "b"}, "merged" + std::to_string(of));
    ASSERT_TRUE(merged) << merged.error().ToString();
    EXPECT_EQ(merged->rows, 100);
    EXPECT_EQ(ResultsIn(folder_.Path("merged" + std::to_string(of))),
              ResultsIn(folder_.Path("whole")))
        << of;
  }
}

TEST_F(MergeTest, TakesShardsWithoutACurve) {
  folder_.Write("strings.jsonl", ManyRows(3));
  ASSERT_TRUE(RunOn(file_, CountTask(), Into(folder_.Path("whole"))));
  for (int k = 1; k <= 10; ++k) Shard(k, 10);
  ASSERT_TRUE(Merge({"shards"}, "merged"));
  EXPECT_EQ(ResultsIn(folder_.Path("merged")), ResultsIn(folder_.Path("whole")));
}

TEST_F(MergeTest, ListsTheShardsThatAreMissingOrUnfinished) {
  for (const int k : {1, 3, 7, 8}) Shard(k, 8);
  const std::string last = folder_.Path("shards") + "/shard-3-of-8.part";
  std::filesystem::resize_file(last, std::filesystem::file_size(last) - 1);
  EXPECT_THAT(MessageOf(Merge({"shards"}, "out")),
              HasSubstr("of 8 shards these are missing: 2,4-6, these have not finished: 3"));
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("out") + "/results.csv"));
}

TEST_F(MergeTest, RefusesShardsThatDoNotBelongTogether) {
  Shard(1, 2);
  Shard(2, 2, "other", 5);
  EXPECT_THAT(MessageOf(Merge({"shards", "other"}, "out")),
              HasSubstr("of another run than the first: these rows were begun with seed 0"));
  Shard(1, 2, "twice");
  EXPECT_THAT(MessageOf(Merge({"shards", "twice"}, "out")), HasSubstr("shard 1 is there twice"));
  Shard(1, 3, "three");
  EXPECT_THAT(MessageOf(Merge({"shards", "three"}, "out")),
              HasSubstr("expected a shard of 2 as the others are, found one of 3"));
  std::filesystem::create_directory(folder_.Path("empty"));
  EXPECT_THAT(MessageOf(Merge({"empty"}, "out")), HasSubstr("no shards in here"));
  EXPECT_THAT(MessageOf(Merge({"nowhere"}, "out")), HasSubstr("cannot read the folder"));
}

TEST_F(MergeTest, SeesThatTheInputChangedBetweenShards) {
  Shard(1, 2);
  folder_.Write("strings.jsonl", ManyRows(101));
  Shard(2, 2);
  EXPECT_THAT(MessageOf(Merge({"shards"}, "out")), HasSubstr("on an input with the digest"));
}

}  // namespace
}  // namespace lyrefit
