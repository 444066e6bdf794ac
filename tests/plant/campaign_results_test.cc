#include "plant/campaign_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "../error_of.h"
#include "lyrefit/base/version.h"
#include "plant/plant_page.h"
#include "plant/plant_runs.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

// A task with the columns of a field test, whose figures are those of the curve.
BatchTaskType FiguresTask(const std::string& beta = "-0.3%") {
  BatchTaskType task;
  task.name = "field-test";
  for (int q = 0; q < kCampaignKept; ++q) {
    task.columns.push_back({kFigureColumns[q], "", CellType::kNumber, "figure"});
    task.columns.push_back({kExpandedColumns[q], "", CellType::kNumber, "its uncertainty"});
  }
  task.columns.push_back({"cause", "", CellType::kText, "of the diagnosis"});
  task.columns.push_back({"cause_about", "", CellType::kText, "what it belongs to"});
  task.options = {{"beta", beta, ""}};
  task.run = [](const BatchCurve& curve, std::uint64_t, const Observer&) {
    const KeyPoints key = FindKeyPoints(curve.curve->voltage_V, curve.curve->current_A);
    TaskResult result;
    for (const double value :
         {key.short_circuit_current_A, key.open_circuit_voltage_V, key.fill_factor, key.max_power_W,
          key.max_power_current_A, key.max_power_voltage_V}) {
      result.cells.push_back(NumberCell(value));
      result.cells.push_back(NumberCell(0.03 * value));
    }
    result.cells.resize(result.cells.size() + 2);
    return result;
  };
  return task;
}

// `count` rows, eight a combiner, in one of two campaigns; every tenth later one has less current.
std::string CampaignRows(int count, bool later) {
  std::string rows;
  for (int i = 0; i < count; ++i) {
    SyntheticString string{fmt::format("site/comb{}/str{}", i / 8, i)};
    string.isc_A = (9 + 0.01 * (i % 7)) * (later ? 0.98 + 0.003 * std::sin(7.0 * i) : 1);
    string.voc_V = 40 + 0.02 * (i % 5) + (later ? 0.05 * std::sin(3.0 * i) : 0);
    if (later && i == 10) string.isc_A *= 0.8;
    rows += RowOf(string);
  }
  return rows;
}

class CampaignResultsTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto done = RunOn(folder_.Write("before.jsonl", CampaignRows(64, false)), FiguresTask(),
                            IntoPlant(Path("before")));
    ASSERT_TRUE(done) << done.error().ToString();
    later_ = folder_.Write("later.jsonl", CampaignRows(64, true));
  }
  std::string Path(const std::string& name) const { return folder_.Path(name); }
  BatchOptions Since(const std::string& before, const std::string& out) const {
    PlantOptions comparisons;
    comparisons.before = before;
    return IntoPlant(Path(out), 2, comparisons, &found_);
  }
  Expected<BatchSummary> Run(const std::string& before, const std::string& out = "out",
                             const BatchTaskType& task = FiguresTask()) const {
    return RunOn(later_, task, Since(before, out));
  }
  std::string AllIn(const std::string& out) const {
    return ResultsIn(Path(out)) + FileText(Path(out) + "/campaign.json");
  }

  const TempFolder folder_;
  std::string later_;
  mutable PlantResults found_;
};

TEST_F(CampaignResultsTest, GivesColumnsSummaryTextAndPage) {
  const auto done = Run(Path("before"));
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(found_.campaign.compared, 64);
  ASSERT_EQ(found_.campaign.changes.size(), 1u);
  EXPECT_EQ(found_.campaign.changes[0].id, "site/comb1/str10");
  EXPECT_NEAR(found_.campaign.plant.percent[0].value, -2, 0.3);
  EXPECT_THAT(BatchText(*done), HasSubstr("Since the last campaign"));
  EXPECT_THAT(BatchText(*done), HasSubstr("site/comb1/str10"));
  const auto columns = CampaignColumns();
  for (const ResultColumn& column : columns) {
    EXPECT_FALSE(column.doc.empty()) << column.name;
    EXPECT_THAT(FileText(Path("out/results.schema.json")), HasSubstr("\"" + column.name + "\""));
  }
  EXPECT_FALSE(fs::exists(Path("out/before.part")));
  ASSERT_TRUE(WritePlantPage(Path("out"), Path("page.html"), "Plant"));
  EXPECT_THAT(FileText(Path("page.html")), HasSubstr("Since the last campaign"));
  EXPECT_THAT(FileText(Path("page.html")), HasSubstr("Power lost since the last campaign"));
  ASSERT_TRUE(WritePlantPage(Path("before"), Path("first.html"), "Plant"));
  EXPECT_THAT(FileText(Path("first.html")), Not(HasSubstr("Since the last campaign")));
}

TEST_F(CampaignResultsTest, TheSummaryReadsBackFromItsJson) {
  const auto done = Run(Path("before"));
  ASSERT_TRUE(done) << done.error().ToString();
  const auto json = nlohmann::ordered_json::parse(FileText(Path("out/campaign.json")));
  EXPECT_EQ(CampaignJson(CampaignOf(json)), json);
  EXPECT_EQ(CampaignJson(found_.campaign), json);
}

TEST_F(CampaignResultsTest, HasTheSameBytesOnThreadsShardsAndResumedRuns) {
  ASSERT_TRUE(Run(Path("before"), "whole"));
  BatchOptions one = Since(Path("before"), "one");
  one.threads = 1;
  ASSERT_TRUE(RunOn(later_, FiguresTask(), one));
  EXPECT_EQ(AllIn("one"), AllIn("whole"));
  BatchOptions resumed = Since(Path("before"), "resumed");
  resumed.threads = 1;  // reads at most 32 rows ahead, so the stop comes before the last of 64
  const auto stopped = RunOn(later_, FiguresTask(), resumed, StopAfter(20));
  ASSERT_TRUE(stopped) << stopped.error().ToString();
  ASSERT_TRUE(stopped->interrupted);
  EXPECT_TRUE(fs::exists(Path("resumed/before.part")));
  resumed.start = BatchStart::kResume;
  ASSERT_TRUE(RunOn(later_, FiguresTask(), resumed));
  EXPECT_EQ(AllIn("resumed"), AllIn("whole"));
  const auto again = RunOn(later_, FiguresTask(), resumed);
  ASSERT_TRUE(again) << again.error().ToString();
  EXPECT_TRUE(again->was_complete);
  EXPECT_FALSE(fs::exists(Path("resumed/before.part")));
  for (int k = 1; k <= 3; ++k) {
    BatchOptions shard = Since(Path("before"), k == 2 ? "shards2" : "shards");
    shard.shard = {k, 3};
    ASSERT_TRUE(RunOn(later_, FiguresTask(), shard));
  }
  fs::remove_all(Path("before"));  // merge needs the copies alone
  const auto merged =
      MergeShards({Path("shards"), Path("shards2")}, MergedInto(Path("merged"), &found_));
  ASSERT_TRUE(merged) << merged.error().ToString();
  EXPECT_EQ(AllIn("merged"), AllIn("whole"));
  EXPECT_EQ(found_.campaign.compared, 64);
}

TEST_F(CampaignResultsTest, TheTableGivesTheSameAsTheLines) {
  ASSERT_TRUE(Run(Path("before") + "/results.csv", "table"));
  ASSERT_TRUE(Run(Path("before") + "/results.jsonl", "lines"));
  EXPECT_EQ(AllIn("table"), AllIn("lines"));
}

TEST_F(CampaignResultsTest, AnotherPastIsAnotherRun) {
  BatchOptions options = Since(Path("before"), "out");
  options.threads = 1;
  const auto stopped = RunOn(later_, FiguresTask(), options, StopAfter(20));
  ASSERT_TRUE(stopped && stopped->interrupted);
  folder_.Write("other.jsonl", CampaignRows(63, false));
  ASSERT_TRUE(RunOn(Path("other.jsonl"), FiguresTask(), IntoPlant(Path("other"))));
  options.additions = Since(Path("other"), "out").additions;
  options.start = BatchStart::kResume;
  const std::string copy = FileText(Path("out/before.part"));
  EXPECT_THAT(MessageOf(RunOn(later_, FiguresTask(), options)), HasSubstr("with before "));
  EXPECT_EQ(FileText(Path("out/before.part")), copy) << "the run can still be resumed";
  for (int k = 1; k <= 2; ++k) {
    BatchOptions shard = Since(k == 1 ? Path("before") : Path("other"), "shards");
    shard.shard = {k, 2};
    ASSERT_TRUE(RunOn(later_, FiguresTask(), shard));
  }
  EXPECT_THAT(MessageOf(MergeShards({Path("shards")}, MergedInto(Path("merged"), &found_))),
              HasSubstr("this shard is of another run"));
}

TEST_F(CampaignResultsTest, ACopyThatWasChangedOrLostIsAnError) {
  for (int k = 1; k <= 2; ++k) {
    BatchOptions shard = Since(Path("before"), "shards");
    shard.shard = {k, 2};
    ASSERT_TRUE(RunOn(later_, FiguresTask(), shard));
  }
  const std::string copy = FileText(Path("shards/before.part"));
  folder_.Write("shards/before.part", copy + " ");
  EXPECT_THAT(MessageOf(MergeShards({Path("shards")}, MergedInto(Path("merged"), &found_))),
              HasSubstr("is not that of the run, or was changed"));
  fs::remove(Path("shards/before.part"));
  EXPECT_THAT(MessageOf(MergeShards({Path("shards")}, MergedInto(Path("merged"), &found_))),
              HasSubstr("before.part, is in no folder"));
}

TEST_F(CampaignResultsTest, ErrorsNameTheirPlace) {
  EXPECT_THAT(MessageOf(Run(Path("nowhere"))), HasSubstr("cannot open the earlier results"));
  fs::create_directory(Path("empty"));
  EXPECT_THAT(MessageOf(Run(Path("empty"))), HasSubstr("results.jsonl or results.csv"));
  folder_.Write("empty/results.part", "");
  EXPECT_THAT(MessageOf(Run(Path("empty"))), HasSubstr("has not finished"));
  EXPECT_THAT(MessageOf(Run(Path("before"), "before")), HasSubstr("name another folder"));
  EXPECT_THAT(MessageOf(Run(Path("before"), "out", CountTask())),
              HasSubstr("--before is for --task field-test"));
  EXPECT_THAT(MessageOf(Run(Path("before"), "out", FiguresTask("-0.28%"))),
              HasSubstr("were made with beta -0.3%, these are with -0.28%"));
  ASSERT_TRUE(RunOn(later_, CountTask(), IntoPlant(Path("count"))));
  EXPECT_THAT(
      MessageOf(Run(Path("count"))),
      HasSubstr("expected results of batch --task field-test, found those of --task count"));
}

TEST_F(CampaignResultsTest, BrokenRowsHaveLineAndColumn) {
  const auto error_of = [&](const std::string& name, const std::string& text) {
    const auto read = ReadEarlierResults(folder_.Write(name, text));
    return read ? std::string("no error") : read.error().ToString();
  };
  std::string lines = FileText(Path("before/results.jsonl"));
  EXPECT_THAT(error_of("a.jsonl", lines.substr(0, lines.size() / 2)),
              HasSubstr("expected a JSON object, a row of results"));
  EXPECT_THAT(error_of("b.jsonl", "{\"id\":\"a\"}\n"), HasSubstr("b.jsonl:1"));
  EXPECT_THAT(error_of("b.jsonl", "{\"id\":\"a\"}\n"), HasSubstr("no column Isc_stc_A"));
  const std::size_t second = lines.find("\"Voc_stc_V\":", lines.find('\n'));
  lines.insert(second + 12, "\"x\",\"y\":");
  EXPECT_THAT(error_of("c.jsonl", lines), HasSubstr("c.jsonl:2: Voc_stc_V: expected a number"));
  std::string table = FileText(Path("before/results.csv"));
  EXPECT_THAT(error_of("d.csv", "id,FF\na,1\n"), HasSubstr("d.csv:1"));
  const std::size_t row = table.find('\n') + 1;
  EXPECT_THAT(error_of("e.csv", table.substr(0, row) + "a,b\n"), HasSubstr("e.csv:2:1: expected"));
  std::string fields;
  const auto commas = std::count(table.begin(), table.begin() + row, ',');
  for (int k = 0; k < commas; ++k) fields += "z,";
  EXPECT_THAT(error_of("f.csv", table.substr(0, row) + fields + "z\n"),
              HasSubstr("expected a number, found 'z'"));
  EXPECT_THAT(error_of("g.csv", table.substr(0, row)), HasSubstr("have no rows"));
}

TEST_F(CampaignResultsTest, AnotherVersionIsARemark) {
  std::string schema = FileText(Path("before/results.schema.json"));
  const std::string now = "\"version\": \"" + std::string(Version()) + "\"";
  ASSERT_NE(schema.find(now), std::string::npos);
  schema.replace(schema.find(now), now.size(), "\"version\": \"0.0.1\"");
  folder_.Write("before/results.schema.json", schema);
  const auto done = Run(Path("before"));
  ASSERT_TRUE(done) << done.error().ToString();
  ASSERT_EQ(found_.campaign.remarks.size(), 1u);
  EXPECT_THAT(found_.campaign.remarks[0], HasSubstr("by lyrefit 0.0.1"));
}

TEST_F(CampaignResultsTest, ASchemaOfOtherTypesAndAPipeAreRefusedWithTheirFile) {
  std::string schema = FileText(Path("before/results.schema.json"));
  const std::string task = "\"task\": \"field-test\"";
  ASSERT_NE(schema.find(task), std::string::npos);
  schema.replace(schema.find(task), task.size(), "\"task\": 7");
  const std::string file = folder_.Write("before/results.schema.json", schema);
  ExpectErrorAt(ReadEarlierResults(Path("before")), file, 0, 0,
                "a value is of another type than expected: type must be string, but is number");
  const std::string pipe = Path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(MessageOf(ReadEarlierResults(pipe)), HasSubstr("found a pipe or a device"));
}

}  // namespace
}  // namespace lyrefit
