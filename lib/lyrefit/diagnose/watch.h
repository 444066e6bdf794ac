#pragma once

#include <cstdint>
#include <memory>

#include "lyrefit/base/observer.h"

namespace lyrefit {

// Reports the progress of a diagnosis to an observer and stores its stop request. Thread-safe.
// Stopped() is cheap enough for every loop: it calls the observer at most every 20 ms.
class Watch {
 public:
  explicit Watch(Observer observer);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // Starts a stage of `steps` steps. `name` must outlive the watch.
  void Begin(const char* name, std::int64_t steps);
  void Step();  // completes one step of the stage
  bool Stopped();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Versions for a watch that may be null (nobody observes).
inline void Begin(Watch* watch, const char* name, std::int64_t steps) {
  if (watch != nullptr) watch->Begin(name, steps);
}
inline void Step(Watch* watch) {
  if (watch != nullptr) watch->Step();
}
inline bool Stopped(Watch* watch) { return watch != nullptr && watch->Stopped(); }

}  // namespace lyrefit
