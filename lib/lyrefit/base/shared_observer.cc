#include "lyrefit/base/shared_observer.h"
#include "lyrefit/base/seconds.h"

namespace lyrefit {
namespace {

constexpr double kPeriod_s = 0.05;  // shortest time between calls from inside jobs

}  // namespace

SharedObserver::SharedObserver(const Observer& observer, std::string_view stage, std::int64_t jobs,
                               double work)
    : observer_(observer), work_(work) {
  progress_.stage = stage;
  progress_.iterations = jobs;
}

void SharedObserver::Count(double work) {
  ++progress_.iteration;
  work_done_ += work;
  if (work_ > 0) progress_.part = work_done_ / work_;
}

void SharedObserver::SkipJob(double work) { Count(work); }

void SharedObserver::Begin() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Tell();
}

void SharedObserver::FinishJob(double work, std::int64_t evaluations) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Count(work);
  progress_.evaluations += evaluations;
  Tell();
}

bool SharedObserver::Stopped() {
  if (stopped_ || !observer_) return stopped_;
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (lock.owns_lock() && SecondsSince(told_) >= kPeriod_s) Tell();
  return stopped_;
}

Observer SharedObserver::Inside() {
  if (!observer_) return {};
  return [this](const Progress& /*inside*/) {
    return Stopped() ? ObserverAction::kStop : ObserverAction::kContinue;
  };
}

std::function<bool()> SharedObserver::Proceed() {
  if (!observer_) return {};
  return [this] { return !Stopped(); };
}

void SharedObserver::Tell() {
  told_ = Now();
  progress_.seconds = SecondsSince(begin_);
  if (!stopped_ && StopRequested(observer_, progress_)) stopped_ = true;
}

}  // namespace lyrefit
