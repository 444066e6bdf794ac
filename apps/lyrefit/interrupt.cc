#include "interrupt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>

namespace lyrefit {
namespace {

constexpr std::chrono::milliseconds kProgressPeriod(100);

volatile std::sig_atomic_t interrupted = 0;

void OnInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

void ShowProgress(const Progress& progress) {
  const std::string planned =
      progress.iterations > 0 ? fmt::format(" of {}", progress.iterations) : std::string();
  const std::string line =
      fmt::format("{}: iteration {}{}, {} evaluations, best {:.6g}", progress.stage,
                  progress.iteration, planned, progress.evaluations, progress.best);
  fmt::print(stderr, "\r{:<79.79}", line);
  std::fflush(stderr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  std::signal(SIGINT, OnInterrupt);
}

InterruptGuard::~InterruptGuard() { std::signal(SIGINT, SIG_DFL); }

Observer TerminalObserver() {
  using Clock = std::chrono::steady_clock;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  return [terminal, last = Clock::now()](const Progress& progress) mutable {
    if (terminal && Clock::now() - last >= kProgressPeriod) {
      last = Clock::now();
      ShowProgress(progress);
    }
    return interrupted != 0 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
}

void ClearProgressLine() {
  if (isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "\r{:<79}\r", "");
  std::fflush(stderr);
}

}  // namespace lyrefit
