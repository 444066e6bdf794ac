#pragma once

#include "lyrefit/base/observer.h"

namespace lyrefit {

// While it lives, the first Ctrl-C asks the computation to stop cleanly; a second one ends the
// program.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

// Stops on Ctrl-C, and shows one changing line on standard error if that is a terminal.
Observer TerminalObserver();

// Wipes that line.
void ClearProgressLine();

}  // namespace lyrefit
