#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/seconds.h"

namespace lyrefit {

// Reports the progress of the stages of one fit to the observer and stores its request to stop.
// Thread-safe: calls of the observer are serialised.
class FitWatch {
 public:
  explicit FitWatch(const Observer& observer) : observer_(observer) {}

  // Begins a stage of `planned` steps (0: unknown). `stage` must outlive the watch.
  void Begin(std::string_view stage, std::int64_t planned) {
    const std::lock_guard<std::mutex> lock(asking_);
    progress_ = {};
    progress_.stage = stage;
    progress_.iterations = planned;
    begin_ = Now();
  }

  // Counts one more step. True: stop.
  bool Next() { return Ask(1); }
  // True: stop.
  bool Stop() { return Ask(0); }
  std::function<bool()> stop() {
    return [this] { return Stop(); };
  }
  void MarkStopped() { stopped_ = true; }
  bool stopped() const { return stopped_; }

 private:
  bool Ask(int steps) {
    const std::lock_guard<std::mutex> lock(asking_);
    progress_.iteration += steps;
    progress_.seconds = SecondsSince(begin_);
    if (!stopped_ && StopRequested(observer_, progress_)) stopped_ = true;
    return stopped_;
  }

  const Observer& observer_;
  std::mutex asking_;
  Progress progress_;
  Instant begin_ = Now();
  bool stopped_ = false;
};

}  // namespace lyrefit
