#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "run_app.h"

extern char** environ;

namespace lyrefit {
namespace {

using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Starts the app without a shell, so that the signal reaches it.
pid_t StartApp(std::vector<std::string> arguments, const std::string& out) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::vector<char*> words;
  arguments.insert(arguments.begin(), LYREFIT_APP);
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  pid_t child = -1;
  posix_spawn(&child, LYREFIT_APP, &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

// How long the app may take to end: the promise holds for the command as it ships, and the
// sanitizers make everything several times slower.
#ifdef __SANITIZE_ADDRESS__
constexpr double kPatience_s = 5;
#else
constexpr double kPatience_s = 1;
#endif

// Whether the process catches SIGINT by now.
bool Listens(pid_t child) {
  std::ifstream status("/proc/" + std::to_string(child) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) == 0) {
      return (std::stoull(line.substr(7), nullptr, 16) & (1ULL << (SIGINT - 1))) != 0;
    }
  }
  return true;  // it has ended
}

// Ctrl-C a while after the search began; returns the wait status and how long the app took to end.
std::pair<int, double> InterruptIt(pid_t child) {
  while (!Listens(child)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const auto begin = Clock::now();
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  return {status, std::chrono::duration<double>(Clock::now() - begin).count()};
}

const std::vector<std::string> kLongRun = {
    "fit",  DataFolder("rtc_france"), "--model", "td", "--population",
    "1000", "--iterations",           "1000000"};

TEST(Interrupt, EndsALongSearchWithinASecondAndReports) {
  const TempFolder folder;
  const std::string out = folder.Path("out.txt");
  const pid_t child = StartApp(kLongRun, out);
  ASSERT_GT(child, 0);
  const auto [status, seconds] = InterruptIt(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_LT(seconds, kPatience_s);
  EXPECT_THAT(FileText(out), StartsWith("INTERRUPTED"));
  EXPECT_THAT(FileText(out), HasSubstr("searched (best bird)"));
}

TEST(Interrupt, IsMarkedInTheJson) {
  const TempFolder folder;
  const std::string out = folder.Path("out.json");
  std::vector<std::string> arguments = kLongRun;
  arguments.insert(arguments.end(), {"--json", "-"});
  const pid_t child = StartApp(arguments, out);
  ASSERT_GT(child, 0);
  const auto [status, seconds] = InterruptIt(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const nlohmann::json j = nlohmann::json::parse(FileText(out), nullptr, false);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  EXPECT_EQ(j["search"]["termination"], "interrupted");
  EXPECT_TRUE(j["rmse"]["searched"]["solved_current_A"].is_number());
}

TEST(Interrupt, EndsAutoToo) {
  const TempFolder folder;
  std::vector<std::string> arguments = kLongRun;
  arguments[3] = "auto";
  const pid_t child = StartApp(arguments, folder.Path("out.txt"));
  ASSERT_GT(child, 0);
  const auto [status, seconds] = InterruptIt(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_LT(seconds, kPatience_s);
  EXPECT_THAT(FileText(folder.Path("out.txt")), StartsWith("INTERRUPTED"));
}

}  // namespace
}  // namespace lyrefit
