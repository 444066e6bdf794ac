#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/seconds.h"

namespace lyrefit {

// One observer for the jobs of a stage, which may run side by side: it is called from one thread at
// a time, hears of the stage when it begins and after every job, and in between as often as the
// jobs look up, at most every few milliseconds.
class SharedObserver {
 public:
  // `observer` and `stage` outlive it. `work` is that of all jobs, where they differ in size, in
  // any unit; 0: all are alike.
  SharedObserver(const Observer& observer, std::string_view stage, std::int64_t jobs,
                 double work = 0);

  // Counts a job that an earlier process did, before the stage begins.
  void SkipJob(double work = 0);
  // Tells the observer that the stage begins.
  void Begin();
  // Counts a job and tells the observer.
  void FinishJob(double work = 0, std::int64_t evaluations = 0);

  // Whether the observer wants to stop: for the inside of a job.
  bool Stopped();
  // The same for what takes an observer, or asks whether to go on; empty where nobody watches.
  Observer Inside();
  std::function<bool()> Proceed();

 private:
  void Count(double work);
  void Tell();  // `mutex_` must be held

  const Observer& observer_;
  const double work_;
  const Instant begin_ = Now();
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;  // of what follows
  Instant told_;
  Progress progress_;
  double work_done_ = 0;
};

}  // namespace lyrefit
