#pragma once

#include <cstdint>
#include <memory>

#include "lyrefit/base/observer.h"

namespace lyrefit {

// Tells an observer where a diagnosis stands and remembers whether it wants to stop. Asked from
// every loop, by several threads: it reports the latest step at most every few milliseconds.
class Watch {
 public:
  explicit Watch(Observer observer);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // A stage of `steps` steps begins; `name` outlives the watch.
  void Begin(const char* name, std::int64_t steps);
  void Step();  // one more of the stage's steps is done
  bool Stopped();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Where nobody watches there is no watch.
inline void Begin(Watch* watch, const char* name, std::int64_t steps) {
  if (watch != nullptr) watch->Begin(name, steps);
}
inline void Step(Watch* watch) {
  if (watch != nullptr) watch->Step();
}
inline bool Stopped(Watch* watch) { return watch != nullptr && watch->Stopped(); }

}  // namespace lyrefit
