#include "studies/watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace lyrefit {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void OnInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void WatchSignals() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, OnInterrupt);
}

ObserverAction Watch(const Progress& progress) {
  if (isatty(STDERR_FILENO) != 0 && progress.iterations > 0) {
    fmt::print(stderr, "\r{:<20}{:>8} of {:<8}", progress.stage, progress.iteration,
               progress.iterations);
  }
  return interrupted != 0 ? ObserverAction::kStop : ObserverAction::kContinue;
}

}  // namespace lyrefit
