#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../batch/strings.h"
#include "lyrefit/report/html_parts.h"
#include "run_app.h"
#include "start_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

#ifdef LYREFIT_SANITIZED
constexpr int kRows = 60;
#else
constexpr int kRows = 400;
#endif

class BatchCommand : public testing::Test {
 protected:
  std::vector<std::string> Words(const std::string& out, const std::string& more = "--resume") {
    return {"batch", file_, "--out", folder_.Path(out), "--threads", "2", more};
  }
  AppResult Run(const std::string& out, const std::string& more = "") {
    return RunApp("batch '" + file_ + "' --out '" + folder_.Path(out) + "' --threads 2 " + more);
  }
  std::string PartOf(const std::string& out) { return folder_.Path(out) + "/results.part"; }
  // Resumes the batch until `lines` more rows are written or all are done, then sends `signal`.
  // Returns the exit code.
  int Interrupted(int signal, int lines) {
    const auto before = LinesIn(PartOf("out"));
    const pid_t child = StartApp(Words("out"), folder_.Path("text"), folder_.Path("err"));
    Await(child, [&] { return LinesIn(PartOf("out")) >= before + lines; });
    kill(child, signal);
    return ExitCodeOf(child);
  }

  const TempFolder folder_;
  const std::string file_ = folder_.Write("strings.jsonl", ManyRows(kRows));
};

TEST_F(BatchCommand, LosesNothingToKills) {
  ASSERT_EQ(Run("whole").exit_code, 0);
  int killed = 0;
  for (int i = 0; i < 100 && Interrupted(SIGKILL, i % 7) == -1; ++i) ++killed;
  const AppResult last = Run("out", "--resume");
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_GE(killed, 1);
  EXPECT_EQ(ResultsIn(folder_.Path("out")), ResultsIn(folder_.Path("whole")));
}

TEST_F(BatchCommand, EndsOnSignalsAndGoesOn) {
  ASSERT_EQ(Run("whole").exit_code, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    int exit_code = 0;
    // Repeats if the batch ended before the signal.
    while ((exit_code = Interrupted(signal, 2)) == 0) {
      std::filesystem::remove_all(folder_.Path("out"));
    }
    EXPECT_EQ(exit_code, 130) << FileText(folder_.Path("err"));
    EXPECT_THAT(FileText(folder_.Path("text")),
                HasSubstr("the same command with --resume goes on from there"));
    EXPECT_TRUE(std::filesystem::exists(PartOf("out")));
  }
  EXPECT_EQ(Run("out", "--resume").exit_code, 0);
  EXPECT_EQ(ResultsIn(folder_.Path("out")), ResultsIn(folder_.Path("whole")));
}

TEST_F(BatchCommand, InShardsAndMergedGivesTheSameBytes) {
  ASSERT_EQ(Run("whole").exit_code, 0);
  for (const int of : {1, 3, 8}) {
    const std::string name = "shards" + std::to_string(of);
    for (int k = 1; k <= of; ++k) {
      const AppResult shard = Run(name, fmt::format("--shard {}/{}", k, of));
      EXPECT_EQ(shard.exit_code, 0) << shard.err;
    }
    if (of == 1) {  // one shard is the whole batch
      EXPECT_EQ(ResultsIn(folder_.Path(name)), ResultsIn(folder_.Path("whole")));
      continue;
    }
    const AppResult merged =
        RunApp("merge '" + folder_.Path(name) + "' --out '" + folder_.Path(name + "m") + "'");
    EXPECT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_THAT(merged.out, HasSubstr("fit of many curves"));
    EXPECT_EQ(ResultsIn(folder_.Path(name + "m")), ResultsIn(folder_.Path("whole"))) << of;
  }
}

TEST_F(BatchCommand, RefusesAWriterBesideIt) {
  pid_t child = -1;
  for (int status = 0; !WIFSTOPPED(status);) {  // repeats if the batch ended before it was stopped
    child = StartApp(Words("out", "--force"), folder_.Path("text"), folder_.Path("err"));
    Await(child, [&] { return LinesIn(PartOf("out")) > 0; });
    kill(child, SIGSTOP);
    waitpid(child, &status, WUNTRACED);
  }
  const AppResult second = Run("out", "--resume");
  kill(child, SIGKILL);
  EXPECT_EQ(ExitCodeOf(child), -1);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("another process is writing these rows"));
}

TEST_F(BatchCommand, SumsUpAndKnowsItsExitCodes) {
  const AppResult fine = Run("out");
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
  EXPECT_THAT(fine.out, HasSubstr("broken"));
  EXPECT_THAT(fine.out, HasSubstr("strings compared with those of their combiner"));
  EXPECT_EQ(Run("out").exit_code, 1);
  EXPECT_THAT(Run("out").err, HasSubstr("say --force to replace them"));
  EXPECT_EQ(Run("out", "--quiet --force").out, "");
  EXPECT_THAT(Run("out", "--resume").out, HasSubstr("all rows were there before"));
  const std::string broken = folder_.Write("broken.jsonl", "{\"id\":\"a\",\"voltage_V\":[1]}\n");
  EXPECT_EQ(RunApp("batch '" + broken + "' --out '" + folder_.Path("b") + "'").exit_code, 2);
}

TEST_F(BatchCommand, DiagnosesWithItsOwnFlags) {
  const std::string few = folder_.Write("few.jsonl", ManyRows(3));
  const AppResult done =
      RunApp("batch '" + few + "' --task diagnose --out '" + folder_.Path("out") + "'");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(FileText(folder_.Path("out") + "/results.csv"), HasSubstr(",cause,cause_title,"));
  EXPECT_EQ(RunApp("batch '" + few + "' --task diagnose --force --quiet --out '" +
                   folder_.Path("out") + "'")
                .exit_code,
            0);
}

TEST_F(BatchCommand, TestsStringsInTheFieldOntoAPage) {
  const std::string few = folder_.Write("few.jsonl", ManyRows(2));
  const std::string page = folder_.Path("plant.html");
  const AppResult done = RunApp("batch '" + few + "' --task field-test --effects clip " +
                                "--html '" + page + "' --out '" + folder_.Path("out") + "'");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const std::string lines = FileText(folder_.Path("out") + "/results.jsonl");
  const auto row = nlohmann::json::parse(lines.substr(0, lines.find('\n')));
  EXPECT_EQ(row["rated_power_W"], 300);
  EXPECT_THAT(row["zone"].get<std::string>(), ::testing::ContainsRegex("^(pass|fail|undecided)"));
  EXPECT_GT(row["Pmax_stc_U_W"].get<double>(), 0);
  EXPECT_GT(row["Pmax_stc_W"].get<double>(), row["Pmax_W"].get<double>()) << "at 40 C";
  EXPECT_THAT(FileText(page), HasSubstr("site/comb0"));
}

TEST_F(BatchCommand, WritesPagesOfStringsThatThePlantsPageLeadsTo) {
  const std::string few = folder_.Write("few.jsonl", ManyRows(2));
  const std::string module =
      folder_.Write("module.json", R"({"rated_power_W": 400, "beta_oc_percent_K": -0.28})");
  const AppResult done =
      RunApp("batch '" + few + "' --task field-test --effects clip --module '" + module +
             "' --tracer PVA --operator 'Crew B' --pages failed --plant Elm --html '" +
             folder_.Path("plant.html") + "' --out '" + folder_.Path("out") + "'");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const std::string page = FileText(folder_.Path("out") + "/pages/site/comb0/str0.html");
  EXPECT_THAT(page, HasSubstr("<p>Fail: "));
  EXPECT_THAT(page, HasSubstr("Crew B"));
  EXPECT_THAT(page, Not(HasSubstr("id=\"plotly\"")));
  const std::string plant = FileText(folder_.Path("plant.html"));
  EXPECT_THAT(plant, HasSubstr("<a href=\"./out/pages/site/comb0/str0.html\">site/comb0/str0</a>"));
  EXPECT_THAT(plant, HasSubstr("<h1>Elm</h1>"));
}

// Rows of a batch of two strings, of which one states its temperature.
class BatchConditions : public testing::Test {
 protected:
  std::vector<nlohmann::json> Rows(const std::string& more) {
    const AppResult done = RunApp("batch '" + folder_.Path("plant") + "' --out '" +
                                  folder_.Path("out") + "' --force " + more);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    std::istringstream lines(FileText(folder_.Path("out") + "/results.jsonl"));
    std::vector<nlohmann::json> rows;
    for (std::string line; std::getline(lines, line);) {
      const auto row = nlohmann::json::parse(line);
      if (row.contains("id") && row["id"].is_string()) rows.push_back(row);
    }
    EXPECT_EQ(rows.size(), 2U);
    return rows;
  }
  void SetUp() override {
    const std::string table = FileText(DataFolder("formats") + "/plain.csv");
    folder_.Write("plant/inv/a.csv", "Cell temperature (C),49.8\n" + table);
    folder_.Write("plant/inv/b.csv", table);
  }
  const TempFolder folder_;
};

TEST_F(BatchConditions, FillInWhatNoFileStates) {
  const auto rows = Rows("--temperature-C 20");
  EXPECT_EQ(rows[0]["temperature_C"], 49.8);
  EXPECT_THAT(rows[0]["remark"].get<std::string>(), HasSubstr("49.8 C in line 1 counts, not the 20 "
                                                              "C given (--override)"));
  EXPECT_EQ(rows[1]["temperature_C"], 20);
  EXPECT_TRUE(rows[1]["remark"].is_null());
}

TEST_F(BatchConditions, ReplaceWithOverrideAndSayIt) {
  const auto rows = Rows("--temperature-C 20 --override");
  EXPECT_EQ(rows[0]["temperature_C"], 20);
  EXPECT_EQ(rows[0]["remark"], "20 C given, instead of 49.8 C in line 1");
  EXPECT_TRUE(rows[1]["remark"].is_null());
}

TEST_F(BatchConditions, CellsComeFromThePlanElseTheSheet) {
  const std::string sheet = folder_.Write("m.json", R"({"cells_in_series": 30,
      "bypass_diodes": 3, "modules_in_series": 2})");
  const std::string plan = folder_.Write("p.csv", "id,modules_in_series\ninv/b,3\n");
  const auto rows = Rows("--module '" + sheet + "' --plan '" + plan +
                         "' --task diagnose "
                         "--effects clip");
  EXPECT_EQ(rows[0]["cells_in_series"], 60);
  EXPECT_EQ(rows[0]["remark"], "60 cells and 6 bypass diodes: 2 modules of 30 cells, m.json");
  EXPECT_EQ(rows[1]["cells_in_series"], 90);
  EXPECT_EQ(rows[1]["remark"],
            "90 cells and 9 bypass diodes: 3 modules of 30 cells, plan and m.json");
}

TEST_F(BatchConditions, APlanSaysWhichStringsItDoesNotName) {
  const std::string command = "batch '" + folder_.Path("plant") + "' --temperature-C 20 --force" +
                              " --cells 60 --out '" + folder_.Path("planned") + "' --plan '";
  const std::string none = folder_.Write("none.csv", "id,modules_in_series\nroof,3\n");
  const AppResult refused = RunApp(command + none + "'");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("no id fits a string: the first string is 'inv/a', the first "
                                     "id of the plan 'roof'"));
  const std::string one = folder_.Write("one.csv", "id,modules_in_series\ninv/b,3\n");
  const AppResult done = RunApp(command + one + "'");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("names 1 of 2 strings; 'inv/a' is the first that it does not"));
}

TEST_F(BatchCommand, CountsThePixelsOfASubstrate) {
  const std::string cells = "batch '" + DataFolder("cell") + "/substrate.csv' --task cell --out '" +
                            folder_.Path("cells") + "' ";
  const AppResult done = RunApp(cells);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("2 of 4 work, yield 50 %; hysteresis of pairs: 2 normal"));
  EXPECT_THAT(done.out, HasSubstr("c: shorted; d: dead"));
  EXPECT_EQ(LinesIn(folder_.Path("cells") + "/samples.csv"), 3);
  EXPECT_THAT(FileText(folder_.Path("cells") + "/results.schema.json"), HasSubstr("\"samples\""));
  EXPECT_THAT(RunApp(cells + "--resume").out, HasSubstr("all rows were there before"));
  const AppResult strict = RunApp(cells + "--force --least-efficiency 14.9");
  EXPECT_THAT(strict.out, HasSubstr("1 of 4 work, yield 25 %"));
  EXPECT_THAT(RunApp(cells + "--force --noise field").err, HasSubstr("--noise is not for"));
}

// The rows of some combiners of the made plant.
std::string RowsOfCombiners(const std::vector<std::string>& combiners) {
  std::istringstream all(FileText(std::string(LYREFIT_DATA_DIR) + "/plant/strings.csv"));
  std::string rows, line;
  for (int i = 0; std::getline(all, line); ++i) {
    const bool wanted =
        i == 0 || std::any_of(combiners.begin(), combiners.end(), [&](const std::string& combiner) {
          return line.rfind(combiner + "/", 0) == 0;
        });
    if (wanted) rows += line + "\n";
  }
  return rows;
}

// Each kind of fault of data/plant/truth.csv has one verdict: in the row, on the string's page, on
// the plant's page and in the terminal. Healthy strings are never in need of work.
TEST(BatchOfAPlant, HasOneVerdictAString) {
  const std::string data = std::string(LYREFIT_DATA_DIR) + "/plant/";
  const TempFolder folder;
  const std::string input = folder.Write(
      "few.csv", RowsOfCombiners({"elm/inv01/comb05", "elm/inv01/comb06", "elm/inv01/comb07",
                                  "elm/inv01/comb09", "elm/inv02/comb05"}));
  const AppResult run = RunApp("batch '" + input + "' --task field-test --module '" + data +
                               "module.json' --plan '" + data + "plan.csv' --pages all --out '" +
                               folder.Path("out") + "' --html '" + folder.Path("plant.html") + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string plant = FileText(folder.Path("plant.html"));
  const std::map<std::string, std::string> hidden = {
      {"elm/inv01/comb05/str03", "measure again irr_step"},
      {"elm/inv01/comb05/str19", "work uniform_soiling"},
      {"elm/inv01/comb06/str02", "work graded_shunt"},
      {"elm/inv01/comb07/str07", "work shading"},
      {"elm/inv01/comb07/str10", "work bypassed_substring"},
      {"elm/inv01/comb09/str05", "work missing_module"},
      {"elm/inv01/comb09/str18", "inspect weak_cell"},
      {"elm/inv02/comb05/str09", "work cable_resistance"}};
  std::map<std::string, std::string> named;
  std::istringstream lines(FileText(folder.Path("out/results.jsonl")));
  for (std::string line; std::getline(lines, line);) {
    const auto row = nlohmann::json::parse(line);
    const std::string id = row["id"];
    const std::string page = FileText(folder.Path("out/" + std::string(row["page"])));
    EXPECT_EQ(page.find("DOUBTFUL"), std::string::npos) << id;
    const std::string to_do = "To do: " + std::string(row["string_to_do"]);
    EXPECT_TRUE(page.find(to_do) != std::string::npos) << id;
    if (row["string_to_do"] == "nothing") continue;
    named[id] = std::string(row["string_to_do"]) + " " + std::string(row["string_cause"]);
    const std::string title = row["string_cause_title"], sentence = row["string_sentence"];
    EXPECT_TRUE(page.find(title.substr(1) + " (") != std::string::npos) << id << " " << title;
    const bool visit = row["string_to_do"] != "measure again";
    EXPECT_EQ(plant.find(">" + id + "<") != std::string::npos, visit) << id;
    if (!visit) continue;
    EXPECT_THAT(run.out, HasSubstr(id)) << id;
    EXPECT_TRUE(plant.find(HtmlEscaped(sentence.substr(1))) != std::string::npos) << sentence;
    EXPECT_TRUE(plant.find(HtmlEscaped(row["string_action"])) != std::string::npos) << id;
  }
  EXPECT_EQ(named, hidden);
}

}  // namespace
}  // namespace lyrefit
