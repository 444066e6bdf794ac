#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "temp_folder.h"

extern char** environ;

namespace lyrefit {

// Starts the app without a shell, so that the signal reaches it. Signals that the test itself
// ignores (as under nohup) are reset to their default in the app.
inline pid_t StartApp(std::vector<std::string> arguments, const std::string& out,
                      const std::string& err = {}) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (!err.empty()) {
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t heard;
  sigemptyset(&heard);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&heard, signal);
  posix_spawnattr_setsigdefault(&attributes, &heard);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::vector<char*> words;
  arguments.insert(arguments.begin(), LYREFIT_APP);
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  pid_t child = -1;
  posix_spawn(&child, LYREFIT_APP, &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

// The exit code, -1 if a signal ended it.
inline int ExitCodeOf(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Returns as soon as `state` holds or the child has ended; an ended child can still be waited for.
// There is no timeout here: a state that never holds runs into the time limit of the test.
template <class State>
void Await(pid_t child, const State& state) {
  const auto ended = [child] {
    siginfo_t info = {};
    return waitid(P_PID, child, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child;
  };
  while (!state() && !ended()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

// Current number of lines of a file.
inline std::ptrdiff_t LinesIn(const std::string& path) {
  const std::string text = FileText(path);
  return std::count(text.begin(), text.end(), '\n');
}

// A named pipe that delivers no data, so that its reader blocks.
class SilentPipe {
 public:
  explicit SilentPipe(std::string path) : path_(std::move(path)) {
    EXPECT_EQ(mkfifo(path_.c_str(), 0600), 0);
  }
  ~SilentPipe() {
    if (end_ >= 0) close(end_);
  }
  SilentPipe(const SilentPipe&) = delete;
  SilentPipe& operator=(const SilentPipe&) = delete;

  const std::string& path() const { return path_; }
  // Whether a process has opened the pipe for reading.
  bool IsRead() {
    if (end_ < 0) end_ = open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    return end_ >= 0;
  }

 private:
  std::string path_;
  int end_ = -1;
};

// The app with its standard error on a pseudo-terminal, where it shows its progress.
class ShownApp {
 public:
  ShownApp(const std::vector<std::string>& arguments, const std::string& out) {
    int inner = -1;
    char name[128] = {};
    EXPECT_EQ(openpty(&terminal_, &inner, name, nullptr, nullptr), 0);
    for (const int end : {terminal_, inner}) fcntl(end, F_SETFD, FD_CLOEXEC);
    child_ = StartApp(arguments, out, name);
    close(inner);
  }
  ~ShownApp() { close(terminal_); }
  ShownApp(const ShownApp&) = delete;
  ShownApp& operator=(const ShownApp&) = delete;

  pid_t child() const { return child_; }
  const std::string& shown() const { return shown_; }

  // Reads until the app has printed `until`, a regular expression, or has ended.
  void AwaitShown(const std::string& until) {
    const std::regex awaited(until);
    while (!std::regex_search(shown_, awaited) && ReadOn()) continue;
  }
  int ExitCode() {
    while (ReadOn()) continue;
    return ExitCodeOf(child_);
  }

 private:
  bool ReadOn() {
    char buffer[4096];
    const ssize_t got = read(terminal_, buffer, sizeof buffer);
    if (got > 0) shown_.append(buffer, static_cast<std::size_t>(got));
    return got > 0;
  }

  int terminal_ = -1;
  pid_t child_ = -1;
  std::string shown_;
};

}  // namespace lyrefit
