#include "interrupt.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <string>

namespace lyrefit {
namespace {

constexpr std::chrono::milliseconds kProgressPeriod(100);

volatile std::sig_atomic_t interrupted = 0;

void OnInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

// "0:42", "1:02:03"
std::string ClockText(double seconds) {
  const auto whole = std::llround(std::min(seconds, 359999.0));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// "compare [#########...........] 405 of 900, 0:21 left"
std::string ProgressBar(const Progress& progress) {
  constexpr std::size_t kWidth = 30;
  const double part =
      static_cast<double>(progress.iteration) / static_cast<double>(progress.iterations);
  const auto filled = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * kWidth);
  std::string line =
      fmt::format("{} [{}{}] {} of {}", progress.stage, std::string(filled, '#'),
                  std::string(kWidth - filled, '.'), progress.iteration, progress.iterations);
  if (part > 0) line += fmt::format(", {} left", ClockText(progress.seconds * (1 / part - 1)));
  return line;
}

// One search, whose best is worth watching.
std::string SearchLine(const Progress& progress) {
  const std::string planned =
      progress.iterations > 0 ? fmt::format(" of {}", progress.iterations) : std::string();
  return fmt::format("{}: iteration {}{}, {} evaluations, best {:.6g}", progress.stage,
                     progress.iteration, planned, progress.evaluations, progress.best);
}

void ShowProgress(const Progress& progress) {
  const bool counted = progress.iterations > 0 && progress.stage != "search";
  fmt::print(stderr, "\r{:<79.79}", counted ? ProgressBar(progress) : SearchLine(progress));
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
