#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <regex>

#include "repeats.h"
#include "run_app.h"
#include "start_app.h"

namespace lyrefit {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr int kAlarm_s = 1200;  // ends a process that hangs

// What a run prints on a terminal until it ends. As soon as it has printed `until`, it gets a
// SIGINT (Ctrl-C).
std::string OnTerminal(std::vector<std::string> arguments, const std::string& until) {
  arguments.insert(arguments.begin(), LYREFIT_APP);
  std::vector<char*> words;
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    alarm(kAlarm_s);
    std::signal(SIGINT, SIG_DFL);  // undoes an inherited "ignore"
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
  const TempFolder folder;
  const std::string err = folder.Path("err");
  const pid_t child = StartApp(kStudy, folder.Path("out"), err);
  Await(child, [&] { return LinesIn(err) > 0; });
  kill(child, SIGINT);
  EXPECT_EQ(ExitCodeOf(child), 130);
  const std::string said = FileText(err);
  EXPECT_THAT(said, StartsWith("lyrefit: this takes about "));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

// With --quiet nothing is printed, on a terminal or elsewhere. The run has by then done 1000 rows,
// after which other runs have long printed their first line.
TEST(Progress, IsSilentWhereAsked) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const std::string journal = folder.Path("study.jsonl"), out = folder.Path("out");
  std::vector<std::string> quiet = kStudy;
  quiet.insert(quiet.end(), {"--quiet", "--resume", journal});
  const auto said = [&](pid_t child) {
    const auto before = LinesIn(journal);
    Await(child, [&] { return LinesIn(journal) > before + 1000; });
    kill(child, SIGINT);
  };
  const pid_t elsewhere = StartApp(quiet, out, folder.Path("err"));
  said(elsewhere);
  EXPECT_EQ(ExitCodeOf(elsewhere), 130);
  EXPECT_EQ(FileText(folder.Path("err")), "");
  ShownApp terminal(quiet, out);
  said(terminal.child());
  EXPECT_EQ(terminal.ExitCode(), 130);
  EXPECT_THAT(terminal.shown(), Not(HasSubstr("compare [")));
}

TEST(Progress, SaysNothingElsewhereOfAShortRun) {
  EXPECT_EQ(RunApp("fit '" + DataFolder("rtc_france") + "'").err, "");
}

}  // namespace
}  // namespace lyrefit
