#include "lyrefit/batch/addition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Adds to each row how many of all rows come before its group, and of how many its group is.
class CountAddition final : public BatchAddition {
 public:
  std::vector<std::string> FileNames() const override { return {"count.txt"}; }
  Expected<void> Open(const RowsInput& /*input*/) override {
    all_ = seen_ = 0;
    return {};
  }
  std::vector<ResultColumn> Columns() const override {
    return {{"group_rows", "", CellType::kWhole, "rows of the group"},
            {"all_rows", "", CellType::kWhole, "all rows"}};
  }
  void Learn(const RowGroup& group) override { all_ += static_cast<int>(group.rows.size()); }
  Expected<void> Add(RowGroup* group) override {
    const auto size = static_cast<std::int64_t>(group->rows.size());
    for (ResultRow& row : group->rows) {
      row.cells.emplace_back(group->together ? size : 0);
      row.cells.emplace_back(std::int64_t{all_});
      ++seen_;
    }
    return {};
  }
  AddedReport Report() const override { return {{{"counted", std::to_string(seen_)}}, {}, {}}; }
  std::vector<ResultFile> Files() const override { return {{"count.txt", std::to_string(all_)}}; }

 private:
  int all_ = 0, seen_ = 0;
};

TEST(BatchAddition, LearnsFromAllRowsAndAddsCellsAndFiles) {
  const TempFolder folder;
  const std::string file = folder.Write("strings.jsonl", ManyRows(20));
  BatchOptions options = Into(folder.Path("out"));
  options.additions = {std::make_shared<CountAddition>()};
  for (int run = 0; run < 2; ++run) {  // an addition serves one run after another
    options.start = BatchStart::kReplace;
    const auto done = RunOn(file, CountTask(), options);
    ASSERT_TRUE(done) << done.error().ToString();
    EXPECT_EQ(done->columns.back().name, "all_rows");
    EXPECT_THAT(BatchText(*done), HasSubstr("counted       20"));
    EXPECT_EQ(FileText(folder.Path("out/count.txt")), "20");
    const std::string csv = FileText(folder.Path("out/results.csv"));
    EXPECT_THAT(csv, HasSubstr(",group_rows,all_rows\n"));
    EXPECT_THAT(csv, HasSubstr(",8,20\n"));
    EXPECT_THAT(csv, HasSubstr(",4,20\n"));
  }
  std::filesystem::remove(folder.Path("out/results.csv"));
  std::filesystem::remove(folder.Path("out/results.jsonl"));
  std::filesystem::remove(folder.Path("out/results.schema.json"));
  options.start = BatchStart::kNew;
  const auto refused = RunOn(file, CountTask(), options);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().ToString(), HasSubstr("count.txt"));
}

TEST(BatchAddition, NoneGivesPlainRows) {
  const TempFolder folder;
  ASSERT_TRUE(
      RunOn(folder.Write("strings.jsonl", ManyRows(20)), CountTask(), Into(folder.Path("out"))));
  EXPECT_THAT(FileText(folder.Path("out/results.csv")), HasSubstr(",readings,own_seed\n"));
  EXPECT_THAT(FileText(folder.Path("out/results.schema.json")), Not(HasSubstr("group")));
}

TEST(BatchAddition, GroupsRowsByTheLevelsAbove) {
  EXPECT_EQ(ParentOf("site/inv/comb/str"), "site/inv/comb");
  EXPECT_EQ(ParentOf("str"), "");
}

}  // namespace
}  // namespace lyrefit
