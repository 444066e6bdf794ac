#pragma once

#include <string>

#include "lyrefit/base/observer.h"

namespace lyrefit {

// While it lives, the first Ctrl-C (or SIGTERM, or SIGHUP) asks the computation to stop cleanly; a
// second one ends the program. What the caller had set to be ignored stays so.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

// Lets those signals end the program with exit code 130 from here on: for what takes a moment.
void EndOnSignals();

struct ProgressStyle {
  // The stage that is the whole run: what is left of it is left of all. Empty: none is.
  std::string whole;
  // What Ctrl-C does, for runs that take more than a minute.
  std::string on_interrupt = "Ctrl-C keeps what is done";
};

// Stops on those signals and, while a copy of it lives, tells on standard error what is going on:
// on a terminal one changing line from the first second on, elsewhere nothing; on both one plain
// line as soon as the run is known to exceed a minute.
Observer TerminalObserver(ProgressStyle style = {});

// No such lines from here on.
void SilenceProgress();

}  // namespace lyrefit
