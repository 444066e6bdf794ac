#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/seconds.h"

namespace lyrefit {

// Shares one observer among the jobs of a stage, which may run in parallel. The observer is called
// from one thread at a time: when the stage begins, after every job, and in between when a job
// polls. Calls from inside jobs are at least 50 ms apart.
class SharedObserver {
 public:
  // `observer` and `stage` must outlive the object. `work` is the total over all jobs, in any unit,
  // if jobs differ in size; 0: they do not.
  SharedObserver(const Observer& observer, std::string_view stage, std::int64_t jobs,
                 double work = 0);

  // Counts a job that an earlier process finished. Call it before Begin.
  void SkipJob(double work = 0);
  // Calls the observer for the begin of the stage.
  void Begin();
  // Counts a finished job and calls the observer.
  void FinishJob(double work = 0, std::int64_t evaluations = 0);

  // Polls from inside a job: whether the observer has requested a stop.
  bool Stopped();
  // Wrap Stopped() as an observer, and as a function that returns whether to continue. Both are
  // empty if the observer is empty.
  Observer Inside();
  std::function<bool()> Proceed();

 private:
  void Count(double work);
  void Tell();  // the caller must hold `mutex_`

  const Observer& observer_;
  const double work_;
  const Instant begin_ = Now();
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;  // guards the members below
  Instant told_;
  Progress progress_;
  double work_done_ = 0;
};

}  // namespace lyrefit
