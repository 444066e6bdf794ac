#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <regex>
#include <thread>

#include "repeats.h"
#include "run_app.h"
#include "start_app.h"

namespace lyrefit {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Slow enough for the slowest build; met within seconds.
constexpr int kAlarm_s = 120;

// What a run shows on a terminal until it ends or hears a Ctrl-C, which comes as soon as it has
// shown `until`.
std::string OnTerminal(std::vector<std::string> arguments, const std::string& until) {
  arguments.insert(arguments.begin(), LYREFIT_APP);
  std::vector<char*> words;
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    alarm(kAlarm_s);
    execv(LYREFIT_APP, words.data());
    _exit(127);
  }
  const std::regex awaited(until);
  bool met = false;
  std::string shown;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(terminal, buffer, sizeof buffer)) > 0;) {
    shown.append(buffer, n);
    if (met || !std::regex_search(shown, awaited)) continue;
    met = true;
    kill(child, SIGINT);
  }
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  return shown;
}

// What a run says on standard error, which is no terminal, until it has said something or `seconds`
// are over, when it hears a Ctrl-C.
std::string OnStandardError(const std::vector<std::string>& arguments, int seconds) {
  const TempFolder folder;
  const pid_t child = StartApp(arguments, folder.Path("out"), folder.Path("err"));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (std::chrono::steady_clock::now() < end && FileText(folder.Path("err")).empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  return FileText(folder.Path("err"));
}

const std::vector<std::string> kStudy = {"compare",      DataFolder("rtc_france"),
                                         "--models",     "sd",
                                         "--algorithms", "mlo,random",
                                         "--population", "10",
                                         "--iterations", "20",
                                         "--runs",       "1000000"};

TEST(Progress, ShowsABarAndTheTimeLeftOnATerminal) {
  const std::string left = "of 2000000, about [0-9]+ (minutes|h [0-9]+ min) left";
  const std::string shown = OnTerminal(kStudy, left);
  EXPECT_THAT(shown, HasSubstr("compare [......"));
  EXPECT_THAT(shown, ContainsRegex(left));
  EXPECT_THAT(shown, ContainsRegex("lyrefit: this takes about [0-9]+ (minutes|h [0-9]+ min); "
                                   "Ctrl-C keeps what is done"));
  EXPECT_THAT(shown, HasSubstr("INTERRUPTED"));
}

TEST(Progress, LivesInAStageThatTellsNoEnd) {
  const TempFolder folder;
  const std::string lives = "(floor|sd|dd|td): [0-9]+ done, best [^ ]+, [0-9]+ s";
  const std::string shown = OnTerminal({"certify", LongCurve(folder), "--cells", "60"}, lives);
  EXPECT_THAT(shown, ContainsRegex(lives));
  EXPECT_THAT(shown, HasSubstr("stopping"));
}

TEST(Progress, SaysElsewhereOnceThatARunWillTakeLong) {
  const std::string said = OnStandardError(kStudy, kAlarm_s);
  EXPECT_THAT(said, StartsWith("lyrefit: this takes about "));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST(Progress, IsSilentWhereAsked) {
  SKIP_IF_SANITIZED();
  std::vector<std::string> quiet = kStudy;
  quiet.push_back("--quiet");
  EXPECT_EQ(OnStandardError(quiet, 3), "");
  // A run that ends by itself, after it would have drawn some bars.
  std::vector<std::string> short_study = kStudy;
  short_study.back() = "2000";
  EXPECT_THAT(OnTerminal(short_study, "no such text"), HasSubstr("compare ["));
  short_study.push_back("--quiet");
  EXPECT_THAT(OnTerminal(short_study, "no such text"), Not(HasSubstr("compare [")));
}

TEST(Progress, SaysNothingElsewhereOfAShortRun) {
  EXPECT_EQ(RunApp("fit '" + DataFolder("rtc_france") + "'").err, "");
}

}  // namespace
}  // namespace lyrefit
