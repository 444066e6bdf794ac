#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Progress of a long computation. Progress bars, time limits and Ctrl-C are implemented as
// observers.
struct Progress {
  std::string_view stage;        // "search", "polish", "intervals"
  std::int64_t iteration = 0;    // of this stage, from 1
  std::int64_t iterations = 0;   // planned for this stage; 0: unknown
  std::int64_t evaluations = 0;  // of the objective so far
  double best = 0;               // best objective value so far, in the objective's unit
  double seconds = 0;            // since the stage began
  double lower_bound = 0;        // proven lower bound of `best`, if the stage computes one
  double part = 0;  // finished fraction of the stage's work, if iterations differ in size; 0: they
                    // do not
  std::string_view note = {};  // further text to display: "702 a second, 12 broken"
};

enum class ObserverAction { kContinue, kStop };  // Whether a computation continues.

// A callback, called at most once an iteration and from one thread at a time. kStop ends the
// computation cleanly: the result so far is returned and marked as interrupted. An empty observer
// never stops a computation.
using Observer = std::function<ObserverAction(const Progress&)>;

// Whether the observer requests a stop; false for an empty observer.
inline bool StopRequested(const Observer& observer, const Progress& progress) {
  return observer && observer(progress) == ObserverAction::kStop;
}

}  // namespace lyrefit
