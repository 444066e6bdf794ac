#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "run_app.h"
#include "start_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::vector<std::string> kLongFit = {
    "fit",  DataFolder("rtc_france"), "--model", "td", "--population",
    "1000", "--iterations",           "1000000"};
const std::vector<std::string> kLongCompare = {"compare",      DataFolder("rtc_france"),
                                               "--models",     "sd,dd",
                                               "--algorithms", "mlo,de,random",
                                               "--population", "10",
                                               "--iterations", "20",
                                               "--runs",       "100000"};
std::vector<std::string> With(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

class InterruptTest : public testing::TestWithParam<int> {
 protected:
  // Standard output of a run that gets the signal as soon as it has shown `until`. Uninterrupted,
  // all these runs take hours.
  std::string OutputOf(const std::vector<std::string>& arguments, const std::string& until) {
    ShownApp app(arguments, out_);
    app.AwaitShown(until);
    kill(app.child(), GetParam());
    EXPECT_EQ(app.ExitCode(), 130) << app.shown();
    return FileText(out_);
  }

  nlohmann::json JsonOf(const std::vector<std::string>& arguments, const std::string& until) {
    return nlohmann::json::parse(OutputOf(With(arguments, {"--json", "-"}), until), nullptr, false);
  }

  // Standard output of a run that gets the signal as soon as it reads from the pipe.
  std::string OutputAt(SilentPipe* pipe, const std::vector<std::string>& arguments) {
    const pid_t child = StartApp(arguments, out_, err_);
    Await(child, [pipe] { return pipe->IsRead(); });
    kill(child, GetParam());
    EXPECT_EQ(ExitCodeOf(child), 130) << arguments.front();
    return FileText(out_);
  }
  std::string OutputAtPipe(const std::vector<std::string>& before,
                           const std::vector<std::string>& after = {}) {
    SilentPipe pipe(folder_.Path("pipe" + std::to_string(pipes_++)));
    return OutputAt(&pipe, With(With(before, {pipe.path()}), after));
  }

  const TempFolder folder_;
  const std::string out_ = folder_.Path("out.txt");
  const std::string err_ = folder_.Path("err.txt");
  int pipes_ = 0;
};

const char kSearching[] = "search \\[";

TEST_P(InterruptTest, EndsALongFitAndReports) {
  const std::string text = OutputOf(kLongFit, kSearching);
  EXPECT_THAT(text, StartsWith("INTERRUPTED"));
  EXPECT_THAT(text, HasSubstr("  searched ("));
}

TEST_P(InterruptTest, IsMarkedInTheJsonOfAFit) {
  const nlohmann::json j = JsonOf(kLongFit, kSearching);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  EXPECT_EQ(j["search"]["termination"], "interrupted");
  EXPECT_TRUE(j["rmse"]["searched"]["solved_current_A"].is_number());
}

TEST_P(InterruptTest, EndsAFitOfAllModelsToo) {
  std::vector<std::string> arguments = kLongFit;
  arguments[3] = "auto";
  EXPECT_THAT(OutputOf(arguments, kSearching), StartsWith("INTERRUPTED"));
}

TEST_P(InterruptTest, KeepsTheRunsOfAComparison) {
  const nlohmann::json j = JsonOf(kLongCompare, "\\] [0-9]{3,} of 600000");
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  ASSERT_EQ(j["problems"].size(), 1U) << "of the one it was at";
  EXPECT_EQ(j["problems"][0]["complete"], false);
  EXPECT_EQ(j["problems"][0]["algorithms"].size(), 3U);
  EXPECT_GE(j["problems"][0]["algorithms"][2]["runs"].size(), 2U);
  EXPECT_GT(j["problems"][0]["algorithms"][0]["refined"]["min_A"], 9e-4);
}

TEST_P(InterruptTest, SaysThatAComparisonIsNotComplete) {
  EXPECT_THAT(OutputOf(kLongCompare, "compare \\["),
              StartsWith("INTERRUPTED: only the runs that were done"));
}

TEST_P(InterruptTest, KeepsWhatIsProved) {
  const nlohmann::json j =
      JsonOf({"certify", LongCurve(folder_), "--cells", "60"}, "floor: [0-9]+ done, best [^ ]+");
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  EXPECT_GT(j["floor"]["rmse_A"], 0);
}

TEST_P(InterruptTest, KeepsTheBudgetOfATranslationWithoutItsDraws) {
  const nlohmann::json j = JsonOf({"translate", DataFolder("rtc_france"), "--irradiance-Wm2", "800",
                                   "--temperature-C", "33", "--draws", "10000000"},
                                  "draws \\[[.#]*\\] [1-9]");
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  for (const auto& result : j["results"]) {
    EXPECT_TRUE(result["budget"].is_null() || result["budget"]["draws"] == 0) << result["title"];
  }
}

// The second measurement is a pipe that never delivers data.
TEST_P(InterruptTest, KeepsTheFilesThatWereDiagnosed) {
  EXPECT_THAT(OutputAtPipe({"diagnose", DataFolder("rtc_france")}), HasSubstr("rtc_france"));
}

TEST_P(InterruptTest, KeepsTheFilesThatWereFitted) {
  EXPECT_THAT(OutputAtPipe({"fit", "--threads", "1", DataFolder("rtc_france")}),
              HasSubstr("rtc_france"));
}

TEST_P(InterruptTest, EndsWhatWaitsForAPipe) {
  for (const char* verb :
       {"fit", "certify", "translate", "diagnose", "compare", "audit", "trend"}) {
    EXPECT_EQ(OutputAtPipe({verb}), "") << verb;
  }
  const std::string module = DataFolder("trend") + "/module.json";
  EXPECT_EQ(OutputAtPipe({"trend", "--module", module, "--operating"}), "");
  EXPECT_EQ(OutputAtPipe({"simulate", "--from"}), "");
  EXPECT_EQ(OutputAtPipe({"fit", DataFolder("rtc_france"), "--bounds"}), "");
  for (const char* verb : {"batch", "pack"}) {
    const std::string out = folder_.Path(std::string(verb) + ".jsonl");
    EXPECT_EQ(OutputAtPipe({verb}, {"--out", out}), "") << verb;
    EXPECT_FALSE(std::filesystem::exists(out)) << verb;
  }
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptTest, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) {
                           return signal.param == SIGINT    ? "INT"
                                  : signal.param == SIGTERM ? "TERM"
                                                            : "HUP";
                         });

nlohmann::json Comparison(const std::string& journal) {
  const AppResult result =
      RunApp("compare '" + DataFolder("rtc_france") +
             "' --models sd,dd --algorithms mlo,de,random --population 10 --iterations 20 --runs 6 "
             "--json -" +
             (journal.empty() ? "" : " --resume '" + journal + "'"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
  RemoveSeconds(&json);
  return json;
}

TEST(Resume, LosesNothingButTheRunUnderWayToAKill) {
  const TempFolder folder;
  const std::string journal = folder.Path("study.jsonl");
  const pid_t child = StartApp(With(kLongCompare, {"--resume", journal}), folder.Path("out.txt"),
                               folder.Path("err.txt"));
  Await(child, [&] { return LinesIn(journal) > 10; });
  kill(child, SIGKILL);
  EXPECT_EQ(ExitCodeOf(child), -1);
  const std::string text = FileText(journal);
  ASSERT_GE(std::count(text.begin(), text.end(), '\n'), 3) << "a head and some runs";
  EXPECT_EQ(FileText(folder.Path("out.txt")), "");
  EXPECT_EQ(Comparison(journal), Comparison(""));
  EXPECT_THAT(FileText(journal), StartsWith(text.substr(0, text.rfind('\n'))));
}

TEST(Resume, RefusesAJournalOfWhichADigitWasChanged) {
  const TempFolder folder;
  const std::string journal = folder.Path("study.jsonl");
  const std::string command = "compare '" + DataFolder("rtc_france") +
                              "' --algorithms lo --iterations 20 --runs 2 --resume '" + journal +
                              "'";
  ASSERT_EQ(RunApp(command).exit_code, 0);
  std::string text = FileText(journal);
  const std::size_t digit = text.find('.', text.find("\"searched_A\":")) + 3;
  text[digit] = text[digit] == '1' ? '2' : '1';
  folder.Write("study.jsonl", text);
  const AppResult changed = RunApp(command);
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_THAT(changed.err, HasSubstr("study.jsonl:2: the checksum of this line"));
  EXPECT_EQ(FileText(journal), text);
}

TEST(Resume, RefusesAnotherStudyAndSaysWhatWasDone) {
  const TempFolder folder;
  const std::string journal = folder.Path("study.jsonl");
  Comparison(journal);
  const std::string command = "compare '" + DataFolder("rtc_france") +
                              "' --models sd,dd --algorithms mlo,de,random --population 10 "
                              "--iterations 20 --runs 6 --resume '" +
                              journal + "'";
  const AppResult again = RunApp(command);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("36 of 36 runs were done before"));
  EXPECT_THAT(again.out, Not(HasSubstr("INTERRUPTED")));
  const AppResult other = RunApp(command + " --seed 8");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err,
              HasSubstr("study.jsonl:1: this study was begun with seed: 0; now it is 8"));
}

}  // namespace
}  // namespace lyrefit
