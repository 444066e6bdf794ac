#pragma once

#include <string>

#include "lyrefit/base/file.h"
#include "lyrefit/base/observer.h"

namespace lyrefit {

// During its lifetime the first Ctrl-C (or SIGTERM, or SIGHUP) stops the computation and this
// thread's reading cleanly; a second one ends the program. Signals that the parent process ignores
// stay ignored. Create it when there are results to keep; reading before that needs none.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  StoppableReads reads_;
};

// From here on these signals end the program with exit code 130: there are no results to keep.
void EndOnSignals();

// A second from here the program ends with exit code 130, if it has not ended before: what it still
// computes after a signal must not outlive it by more.
void EndWithinASecond();

// Whether a signal arrived during the lifetime of a guard.
bool Interrupted();

struct ProgressStyle {
  // Name of the stage that is the whole run: its remaining time is that of the run. Empty: none.
  std::string whole;
  // Effect of Ctrl-C, for runs of more than a minute.
  std::string on_interrupt = "Ctrl-C keeps what is done";
};

// Observer that stops on those signals and, until its last copy is destroyed, reports progress on
// standard error. On a terminal: one changing line from the first second on. In any case one plain
// line as soon as the run is known to exceed a minute.
Observer TerminalObserver(ProgressStyle style = {});

// Switches off these lines.
void SilenceProgress();

}  // namespace lyrefit
