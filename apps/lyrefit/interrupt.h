#pragma once

#include <string>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/stoppable_reads.h"

namespace lyrefit {

// While it lives, the first Ctrl-C (or SIGTERM, or SIGHUP) asks the computation, and what this
// thread reads, to stop cleanly; a second one ends the program. What the caller had set to be
// ignored stays so. It begins where there is something to keep: what is read before needs none.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  StoppableReads reads_;
};

// Lets those signals end the program with exit code 130 from here on: where nothing is to be kept.
void EndOnSignals();

// Whether a signal has come while a guard lived.
bool Interrupted();

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
