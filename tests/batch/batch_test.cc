#include "lyrefit/batch/batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../error_of.h"
#include "../file_limit.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Batch, GivesTheSameBytesOnAnyNumberOfThreads) {
  const TempFolder folder;
  const std::string file = folder.Write("strings.jsonl", ManyRows(40));
  for (const BatchTaskType& task : {CountTask(), FitTask(BatchFitOptions())}) {
    std::string one;
    for (const int threads : {1, 2, 4}) {
      const std::string out = folder.Path(task.name + std::to_string(threads));
      const auto done = RunOn(file, task, Into(out, threads));
      ASSERT_TRUE(done) << done.error().ToString();
      EXPECT_EQ(done->rows, 40);
      if (threads == 1) one = ResultsIn(out);
      EXPECT_EQ(ResultsIn(out), one) << task.name << " " << threads;
      EXPECT_FALSE(std::filesystem::exists(out + "/results.part"));
    }
  }
}

TEST(Batch, GivesEveryCurveARowWithStatusAndReason) {
  const TempFolder folder;
  const std::string out = folder.Path("out");
  const auto done =
      RunOn(folder.Write("s.jsonl", ManyRows(20)), FitTask(BatchFitOptions()), Into(out));
  ASSERT_TRUE(done) << done.error().ToString();
  std::ifstream lines(out + "/results.jsonl");
  int row = 0;
  for (std::string line; std::getline(lines, line); ++row) {
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(json.is_object()) << line;
    EXPECT_EQ(json["where"], fmt::format("{}:{}", folder.Path("s.jsonl"), row + 1));
    if (row % 9 == 4) {
      EXPECT_EQ(json["status"], "broken");
      EXPECT_TRUE(json["reason"].is_string()) << line;
      EXPECT_TRUE(json["Iph_A"].is_null());
      continue;
    }
    EXPECT_EQ(json["id"], fmt::format("site/comb{}/str{}", row / 8, row));
    EXPECT_EQ(json["status"], "fine") << line;
    EXPECT_TRUE(json["reason"].is_null());
    EXPECT_EQ(json["rated_power_W"], 300);
    EXPECT_EQ(json["date"], "2026-05-04");
    EXPECT_EQ(json["beside"], R"({"crew":"B"})");
    EXPECT_NEAR(json["Isc_A"].get<double>(), 9 + 0.01 * (row % 7), 1e-3);
    EXPECT_NEAR(json["Iph_A"].get<double>(), 9, 0.3);
    EXPECT_GT(json["Iph_A_se"].get<double>(), 0);
  }
  EXPECT_EQ(row, 20);
  EXPECT_EQ(done->statuses.at("broken"), 2);
  EXPECT_EQ(done->reasons.size(), 1U);
}

TEST(Batch, DescribesItsColumns) {
  const TempFolder folder;
  const std::string out = folder.Path("out");
  ASSERT_TRUE(RunOn(folder.Write("s.jsonl", ManyRows(3)), CountTask(), Into(out)));
  const auto schema = nlohmann::json::parse(FileText(out + "/results.schema.json"));
  std::string head;
  for (const auto& field : schema["fields"]) {
    head += (head.empty() ? "" : ",") + field["name"].get<std::string>();
    EXPECT_GT(field["description"].get<std::string>().size(), 5U) << field;
  }
  const std::string csv = FileText(out + "/results.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), head);
  EXPECT_EQ(schema["lyrefit"]["task"], "count");
}

TEST(Batch, IsTakenUpWhereItWasStopped) {
  const TempFolder folder;
  const std::string file = folder.Write("strings.jsonl", ManyRows(300));
  ASSERT_TRUE(RunOn(file, CountTask(), Into(folder.Path("whole"))));
  BatchOptions options = Into(folder.Path("out"));
  options.start = BatchStart::kResume;  // starts a new run if there is no checkpoint
  std::int64_t before = 0;
  int stops = 0;
  while (true) {
    const auto done = RunOn(file, CountTask(), options, StopAfter(before + 1));
    ASSERT_TRUE(done) << done.error().ToString();
    EXPECT_EQ(done->rows_before, before);
    if (!done->interrupted) break;
    ASSERT_LE(++stops, 300);  // every restart must make progress
    before = done->rows;
    // A killed process leaves an incomplete line.
    std::ofstream(CheckpointPath(options.folder, {}), std::ios::app) << "{\"id\":\"site/comb0/st";
  }
  EXPECT_GE(stops, 1);
  EXPECT_EQ(ResultsIn(options.folder), ResultsIn(folder.Path("whole")));
  const auto again = RunOn(file, CountTask(), options);
  ASSERT_TRUE(again) << again.error().ToString();
  EXPECT_TRUE(again->was_complete);
}

TEST(Batch, IsTakenUpWhereItWasStoppedWhileItsResultsWereWritten) {
  const TempFolder folder;
  const std::string file = folder.Write("strings.jsonl", ManyRows(300));
  ASSERT_TRUE(RunOn(file, CountTask(), Into(folder.Path("whole"))));
  BatchOptions options = Into(folder.Path("out"));
  const auto stopped = RunOn(file, CountTask(), options, StopAfter(1, "results"));
  ASSERT_TRUE(stopped) << stopped.error().ToString();
  EXPECT_TRUE(stopped->interrupted);
  EXPECT_EQ(stopped->rows, 300);
  EXPECT_EQ(ResultsIn(options.folder), "");
  options.start = BatchStart::kResume;
  const auto done = RunOn(file, CountTask(), options);
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->rows_before, 300);
  EXPECT_FALSE(done->interrupted);
  EXPECT_EQ(ResultsIn(options.folder), ResultsIn(folder.Path("whole")));
}

class Unfinished : public testing::Test {
 protected:
  Unfinished() : file_(folder_.Write("strings.jsonl", ManyRows(200))) {
    options_.folder = folder_.Path("out");
    options_.threads = 2;
    const auto done = RunOn(file_, CountTask(), options_, StopAfter(1));
    EXPECT_TRUE(done && done->interrupted);
    part_ = FileText(options_.folder + "/results.part");
    options_.start = BatchStart::kResume;
  }

  // The run is refused and the checkpoint is unchanged.
  void ExpectRefusal(const BatchTaskType& task, const std::string& sentence) {
    EXPECT_THAT(MessageOf(RunOn(file_, task, options_)), HasSubstr(sentence));
    EXPECT_EQ(FileText(options_.folder + "/results.part"), part_);
  }

  const TempFolder folder_;
  const std::string file_;
  BatchOptions options_;
  std::string part_;
};

TEST_F(Unfinished, IsNotWrittenOverUnasked) {
  options_.start = BatchStart::kNew;
  ExpectRefusal(CountTask(), "a run was not finished here: say --resume to go on, or --force");
}

TEST_F(Unfinished, IsNotGoneOnWithOnAnotherInput) {
  std::string rows = FileText(file_);
  rows[rows.size() - 10] = rows[rows.size() - 10] == '1' ? '2' : '1';
  folder_.Write("strings.jsonl", rows);
  ExpectRefusal(CountTask(), "these rows were begun on an input with the digest ");
}

TEST_F(Unfinished, IsNotGoneOnWithUnderOtherOptions) {
  options_.seed = 7;
  ExpectRefusal(CountTask(), "these rows were begun with seed 0, now it is 7: go on as it was");
  options_.seed = 0;
  BatchTaskType task = CountTask();
  task.options = {{"model", "dd", "sd"}};
  ExpectRefusal(task, "these rows were begun with model nothing, now it is dd");
  task = CountTask();
  task.name = "weigh";
  ExpectRefusal(task, "these rows were begun with task count, now it is weigh");
}

TEST_F(Unfinished, IsNotGoneOnWithByAnotherVersion) {
  const std::string head = part_.substr(0, part_.rfind(",\"crc\"", part_.find('\n'))) + "}";
  const std::string version = "\"version\":\"";
  std::string other = head;
  other.insert(other.find(version) + version.size(), "9.");
  part_ = LineSums().Seal(other) + "\n";
  std::ofstream(options_.folder + "/results.part", std::ios::binary) << part_;
  ExpectRefusal(CountTask(), "these rows were begun by lyrefit 9.");
}

TEST_F(Unfinished, IsNotWrittenByTwo) {
  auto head = nlohmann::ordered_json::parse(part_.substr(0, part_.find('\n')));
  head.erase("crc");
  const auto held =
      CheckpointFile::Open(options_.folder + "/results.part", head, PartStart::kResume);
  ASSERT_TRUE(held) << held.error().ToString();
  ExpectRefusal(CountTask(), "another process is writing these rows");
}

TEST_F(Unfinished, IsLeftAloneIfDamaged) {
  part_.insert(part_.find('\n') + 1, std::string(3, '\0') + "\n");
  std::ofstream(options_.folder + "/results.part", std::ios::binary) << part_;
  ExpectRefusal(CountTask(), "the checksum of this line is not that of what stands up to here");
}

// Root may open every file. While an object lives, a process of root runs as the user nobody.
class AsNobody {
 public:
  AsNobody() {
    if (root_) Become(65534);
  }
  ~AsNobody() {
    if (root_) Become(0);
  }

 private:
  static void Become(uid_t user) { EXPECT_EQ(seteuid(user), 0); }

  const bool root_ = geteuid() == 0;
};

TEST(Batch, LosesNothingToAFullDisk) {
  const TempFolder folder;
  const std::string file = folder.Write("strings.jsonl", ManyRows(200));
  ASSERT_TRUE(RunOn(file, CountTask(), Into(folder.Path("whole"))));
  BatchOptions options = Into(folder.Path("out"));
  options.start = BatchStart::kResume;
  // A limit below the size of the checkpoint, and one below the size of the results.
  const auto lines = std::filesystem::file_size(folder.Path("whole") + "/results.jsonl");
  for (const rlim_t bytes : {rlim_t{20000}, static_cast<rlim_t>(lines - 100)}) {
    const FileLimit limit(bytes);
    const auto done = RunOn(file, CountTask(), options);
    EXPECT_THAT(MessageOf(done), HasSubstr("cannot write the ")) << bytes;
    // Rows are written in groups; if the first group does not fit, no checkpoint remains.
    const std::string part = options.folder + "/results.part";
    const bool kept = std::filesystem::exists(part);
    if (kept) {
      EXPECT_EQ(FileText(part).back(), '\n');
    }
    EXPECT_FALSE(std::filesystem::exists(options.folder + "/results.csv"));
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(options.folder)) {
      files += entry.is_regular_file() ? 1 : 0;
    }
    EXPECT_EQ(files, kept ? 1 : 0) << "nothing is left lying about";
  }
  const auto done = RunOn(file, CountTask(), options);
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_GT(done->rows_before, 0);
  EXPECT_EQ(ResultsIn(options.folder), ResultsIn(folder.Path("whole")));
}

TEST(Batch, MakesABrokenRowOfAFileThatCannotBeOpened) {
  const TempFolder folder;
  const std::string row = "V,A\n0,8\n10,7.9\n20,7.5\n30,0\n";
  for (const char* name : {"t/a.csv", "t/b.csv", "t/c.csv"}) folder.Write(name, row);
  using std::filesystem::perms;
  std::filesystem::permissions(folder.Path("t/b.csv"), perms::none);
  std::filesystem::permissions(folder.Path(""), perms::all);
  Expected<BatchSummary> done;
  {
    const AsNobody nobody;
    done = RunOn(folder.Path("t"), CountTask(), Into(folder.Path("out")));
  }
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->rows, 3);
  EXPECT_EQ(done->statuses.at("broken"), 1);
  EXPECT_THAT(FileText(folder.Path("out") + "/results.csv"),
              HasSubstr("b,broken,cannot open the file: Permission denied,"));
}

TEST(Batch, WritesNoFormulasIntoItsTable) {
  const TempFolder folder;
  std::string rows;
  for (const char* id : {"=cmd|' /C calc'!A0", "\\t=1+1", "+1+1", "-0.5", "@SUM(1)", "str 1"}) {
    rows += RowOf({id});
  }
  const std::string file = folder.Write("s.jsonl", rows);
  ASSERT_TRUE(RunOn(file, CountTask(), Into(folder.Path("out"))));
  const auto ids_in = [&](const std::string& out) {
    std::ifstream csv(folder.Path(out) + "/results.csv");
    std::string ids, line;
    std::getline(csv, line);
    while (std::getline(csv, line)) ids += line.substr(0, line.find(',')) + "\n";
    return ids;
  };
  EXPECT_EQ(ids_in("out"), "'=cmd|' /C calc'!A0\n'=1+1\n'+1+1\n-0.5\n'@SUM(1)\nstr 1\n");
  EXPECT_THAT(FileText(folder.Path("out") + "/results.jsonl"),
              HasSubstr("{\"id\":\"=cmd|' /C calc'!A0\","));
  // Unchanged ids with raw_csv, in one run and in merged shards.
  BatchOptions raw = Into(folder.Path("raw"));
  raw.raw_csv = true;
  ASSERT_TRUE(RunOn(file, CountTask(), raw));
  EXPECT_EQ(ids_in("raw"), "=cmd|' /C calc'!A0\n=1+1\n+1+1\n-0.5\n@SUM(1)\nstr 1\n");
  raw.folder = folder.Path("shards");
  for (raw.shard = {1, 2}; raw.shard.k <= 2; ++raw.shard.k) {
    ASSERT_TRUE(RunOn(file, CountTask(), raw));
  }
  ASSERT_TRUE(MergeShards({raw.folder}, {folder.Path("merged"), false}));
  EXPECT_EQ(ResultsIn(folder.Path("merged")), ResultsIn(folder.Path("raw")));
}

TEST(Batch, TellsFilesApartWhoseNamesAreNoUtf8) {
  const TempFolder folder;
  const std::string row = "V,A\n0,8\n10,7.9\n20,7.5\n30,0\n";
  for (const char* name : {"t/bad\xfe.csv", "t/bad\xff.csv", "t/good\xc3\xa9.csv"}) {
    folder.Write(name, row);
  }
  const auto done = RunOn(folder.Path("t"), CountTask(), Into(folder.Path("out")));
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->statuses.at("fine"), 3);
  for (const char* file : {"/results.csv", "/results.jsonl"}) {
    const std::string text = FileText(folder.Path("out") + file);
    for (const char* id : {"bad%FE", "bad%FF", "good\xc3\xa9", "t/bad%FE.csv", "t/bad%FF.csv"}) {
      EXPECT_THAT(text, HasSubstr(id)) << file;
    }
    EXPECT_THAT(text, Not(HasSubstr("\xef\xbf\xbd"))) << file;
  }
}

TEST(Batch, RefusesAFolderThatCannotBeMadeOrHoldsResults) {
  const TempFolder folder;
  const std::string file = folder.Write("strings.jsonl", ManyRows(3));
  EXPECT_THAT(MessageOf(RunOn(file, CountTask(), Into(file + "/out"))),
              HasSubstr("cannot make the folder of the results"));
  const BatchOptions options = Into(folder.Path("out"));
  ASSERT_TRUE(RunOn(file, CountTask(), options));
  const std::string before = ResultsIn(options.folder);
  EXPECT_THAT(MessageOf(RunOn(file, CountTask(), options)), HasSubstr("results are there already"));
  BatchOptions other = options;
  other.start = BatchStart::kResume;
  other.seed = 3;
  EXPECT_THAT(MessageOf(RunOn(file, CountTask(), other)), HasSubstr("are of another run"));
  EXPECT_EQ(ResultsIn(options.folder), before);
  other.start = BatchStart::kReplace;
  EXPECT_TRUE(RunOn(file, CountTask(), other));
  EXPECT_NE(ResultsIn(options.folder), before);
}

TEST(Batch, DrawsAnotherSeedForEveryCurve) {
  EXPECT_NE(SeedOf(0, "a"), SeedOf(0, "b"));
  EXPECT_NE(SeedOf(0, "a"), SeedOf(1, "a"));
  EXPECT_EQ(SeedOf(5, "site/inv/str"), SeedOf(5, "site/inv/str"));
}

TEST(Batch, SaysWhatCameOfIt) {
  const TempFolder folder;
  const auto done =
      RunOn(folder.Write("s.jsonl", ManyRows(20)), CountTask(), Into(folder.Path("out")));
  ASSERT_TRUE(done);
  const std::string text = BatchText(*done);
  EXPECT_THAT(text, HasSubstr("count of many curves"));
  EXPECT_THAT(text, HasSubstr("Why rows are not fine"));
  EXPECT_THAT(text, HasSubstr("90.0 %"));
  EXPECT_THAT(text, Not(HasSubstr("INTERRUPTED")));
}

}  // namespace
}  // namespace lyrefit
