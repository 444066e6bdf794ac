#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Where a long computation stands. Progress bars, time limits and Ctrl-C are observers.
struct Progress {
  std::string_view stage;        // "search", "polish", "intervals"
  std::int64_t iteration = 0;    // of this stage, from 1
  std::int64_t iterations = 0;   // planned for this stage, 0 when open
  std::int64_t evaluations = 0;  // of the objective so far
  double best = 0;               // best objective value so far, in the objective's own unit
  double seconds = 0;            // since the stage began
  double lower_bound = 0;        // proved for `best`, where the stage proves one
  double part = 0;  // of the stage's work that is done, where iterations differ in size; 0: they
                    // are alike
  std::string_view note = {};  // what else there is to say: "702 a second, 12 broken"
};

enum class ObserverAction { kContinue, kStop };  // Whether a computation is to go on.

// Called once an iteration or more rarely. kStop ends the computation cleanly: what was found so
// far is returned and marked as interrupted. An empty observer means "go on". It is called from one
// thread at a time.
using Observer = std::function<ObserverAction(const Progress&)>;

// Asks an observer, which may be empty.
inline bool StopRequested(const Observer& observer, const Progress& progress) {
  return observer && observer(progress) == ObserverAction::kStop;
}

}  // namespace lyrefit
