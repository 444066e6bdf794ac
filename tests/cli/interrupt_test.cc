#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "run_app.h"
#include "start_app.h"

namespace lyrefit {
namespace {

using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// How long the app may take to end. The command as it ships ends within a second on a quiet
// machine; the sanitizers make everything several times slower.
#ifdef LYREFIT_SANITIZED
constexpr double kPatience_s = 20;
#else
constexpr double kPatience_s = 5;
#endif

struct Ended {
  int exit_code = -1;  // -1: by a signal
  double seconds = 0;  // from the signal to the end
};

// A signal a while after the work began.
Ended Interrupt(pid_t child, int signal) {
  while (!Listens(child, SIGINT)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const auto begin = Clock::now();
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          std::chrono::duration<double>(Clock::now() - begin).count()};
}

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
  // Runs until the signal; the exit code and the time are as promised.
  std::string OutputOf(const std::vector<std::string>& arguments) {
    const std::string out = folder_.Path("out.txt");
    const pid_t child = StartApp(arguments, out);
    EXPECT_GT(child, 0);
    const Ended ended = Interrupt(child, GetParam());
    EXPECT_EQ(ended.exit_code, 130);
    EXPECT_LT(ended.seconds, kPatience_s);
    return FileText(out);
  }

  nlohmann::json JsonOf(const std::vector<std::string>& arguments) {
    return nlohmann::json::parse(OutputOf(With(arguments, {"--json", "-"})), nullptr, false);
  }

  const TempFolder folder_;
};

TEST_P(InterruptTest, EndsALongFitAndReports) {
  const std::string text = OutputOf(kLongFit);
  EXPECT_THAT(text, StartsWith("INTERRUPTED"));
  EXPECT_THAT(text, HasSubstr("searched (best bird)"));
}

TEST_P(InterruptTest, IsMarkedInTheJsonOfAFit) {
  const nlohmann::json j = JsonOf(kLongFit);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  EXPECT_EQ(j["search"]["termination"], "interrupted");
  EXPECT_TRUE(j["rmse"]["searched"]["solved_current_A"].is_number());
}

TEST_P(InterruptTest, EndsAFitOfAllModelsToo) {
  std::vector<std::string> arguments = kLongFit;
  arguments[3] = "auto";
  EXPECT_THAT(OutputOf(arguments), StartsWith("INTERRUPTED"));
}

TEST_P(InterruptTest, KeepsTheRunsOfAComparison) {
  const nlohmann::json j = JsonOf(kLongCompare);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  ASSERT_EQ(j["problems"].size(), 1U) << "of the one it was at";
  EXPECT_EQ(j["problems"][0]["complete"], false);
  EXPECT_EQ(j["problems"][0]["contenders"].size(), 3U);
  EXPECT_GE(j["problems"][0]["contenders"][2]["runs"].size(), 2U);
  EXPECT_GT(j["problems"][0]["contenders"][0]["refined"]["min_A"], 9e-4);
}

TEST_P(InterruptTest, SaysThatAComparisonIsNotComplete) {
  EXPECT_THAT(OutputOf(kLongCompare), StartsWith("INTERRUPTED: only the runs that were done"));
}

TEST_P(InterruptTest, KeepsWhatIsProved) {
  const nlohmann::json j = JsonOf({"certify", LongCurve(folder_), "--cells", "60"});
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  EXPECT_GT(j["floor"]["rmse_A"], 0);
}

TEST_P(InterruptTest, KeepsTheFilesThatWereDiagnosed) {
  std::vector<std::string> arguments = {"diagnose"};
  for (int i = 0; i < 200; ++i) {
    const std::string name = "curve" + std::to_string(i) + ".csv";
    arguments.push_back(folder_.Write(name, FileText(DataFolder("rtc_france") + "/curve.csv")));
  }
  EXPECT_THAT(OutputOf(arguments), HasSubstr("curve0"));
}

TEST_P(InterruptTest, KeepsTheSetsOfACoverageStudy) {
  const nlohmann::json j =
      JsonOf({"coverage", "--sets", "100000", "--curves", "5", "--points", "10"});
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
}

TEST_P(InterruptTest, EndsWhatTakesAMomentToo) {
  const std::string pipe = folder_.Path("pipe");  // nobody writes into it
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(OutputOf({"simulate", "--from", pipe}), "");
  EXPECT_EQ(OutputOf({"audit", pipe}), "");
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
  const pid_t child = StartApp(With(kLongCompare, {"--resume", journal}), folder.Path("out.txt"));
  Interrupt(child, SIGKILL);
  const std::string text = FileText(journal);
  ASSERT_GE(std::count(text.begin(), text.end(), '\n'), 3) << "a head and some runs";
  EXPECT_EQ(FileText(folder.Path("out.txt")), "");
  EXPECT_EQ(Comparison(journal), Comparison(""));
  EXPECT_THAT(FileText(journal), StartsWith(text.substr(0, text.rfind('\n'))));
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
