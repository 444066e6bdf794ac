#pragma once

#include "lyrefit/base/observer.h"

// Interrupts and progress of the programs among the tests.
namespace lyrefit {

constexpr int kExitInterrupted = 130;

// SIGINT and SIGTERM request a stop; a second one ends the program.
void WatchSignals();

// Shows the progress on a terminal, in one line, and stops after a signal.
ObserverAction Watch(const Progress& progress);

}  // namespace lyrefit
