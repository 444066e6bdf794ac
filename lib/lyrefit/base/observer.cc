#include "lyrefit/base/observer.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"

namespace lyrefit {

struct StopToken::State {
  std::function<bool()> poll;
  std::atomic<bool> requested{false};
};

StopToken::StopToken(std::function<bool()> poll) : state_(std::make_shared<State>()) {
  state_->poll = std::move(poll);
}

bool StopToken::Stopped() const {
  if (state_ == nullptr) return false;
  if (!state_->requested && state_->poll && state_->poll()) state_->requested = true;
  return state_->requested;
}

bool StopToken::requested() const { return state_ != nullptr && state_->requested; }

void StopToken::Request() const { state_->requested = true; }

Observer StopToken::AsObserver() const {
  if (state_ == nullptr) return {};
  return [token = *this](const Progress& /*ignored*/) {
    return token.Stopped() ? ObserverAction::kStop : ObserverAction::kContinue;
  };
}

struct ProgressReporter::State {
  State(const Observer& to, double period) : observer(to), period_s(period) {
    if (observer) stop = StopToken([this] { return Poll(); });
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // Does not wait for another thread that calls the observer.
  bool Poll() {
    const std::unique_lock<std::mutex> lock(mutex, std::try_to_lock);
    return lock.owns_lock() && SecondsSince(told) >= period_s && Report(&progress);
  }
  // The caller must hold the mutex.
  bool Report(Progress* figures) {
    told = Now();
    figures->seconds = SecondsSince(begin);
    if (!stop.requested() && StopRequested(observer, *figures)) stop.Request();
    return stop.requested();
  }
  // The caller must hold the mutex.
  void Count(double done, std::int64_t evaluations) {
    if (progress.iterations == 0 || progress.iteration < progress.iterations) ++progress.iteration;
    progress.evaluations += evaluations;
    work_done += done;
    if (work > 0) progress.part = work_done / work;
  }

  const Observer& observer;
  const double period_s;
  StopToken stop{nullptr};
  std::mutex mutex;  // guards the members below
  Instant begin = Now();
  Instant told;
  Progress progress;
  double work = 0;
  double work_done = 0;
};

ProgressReporter::ProgressReporter(const Observer& observer, double period_s)
    : state_(std::make_shared<State>(observer, period_s)) {}

ProgressReporter::ProgressReporter(const Observer& observer, std::string_view stage,
                                   std::int64_t steps)
    : ProgressReporter(observer) {
  Begin(stage, steps);
}

void ProgressReporter::Begin(std::string_view stage, std::int64_t steps) const {
  BeginSilently(stage, steps);
  Report();
}

void ProgressReporter::BeginSilently(std::string_view stage, std::int64_t steps,
                                     double work) const {
  if (state_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->progress = {};
  state_->progress.stage = stage;
  state_->progress.iterations = steps;
  state_->begin = Now();
  state_->work = work;
  state_->work_done = 0;
}

void ProgressReporter::Count(double work, std::int64_t evaluations) const {
  if (state_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->Count(work, evaluations);
}

bool ProgressReporter::Step(double work, std::int64_t evaluations) const {
  if (state_ == nullptr) return false;
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->Count(work, evaluations);
  return state_->Report(&state_->progress);
}

bool ProgressReporter::Report() const {
  if (state_ == nullptr) return false;
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->Report(&state_->progress);
}

bool ProgressReporter::Report(Progress progress) const {
  if (state_ == nullptr) return false;
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->Report(&progress);
}

const StopToken& ProgressReporter::stop() const {
  static const StopToken nobody;
  return state_ == nullptr ? nobody : state_->stop;
}

namespace {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
constexpr bool kHasThreads = false;  // memory is not shared between threads
#else
constexpr bool kHasThreads = true;
#endif

}  // namespace

Expected<void> ValidateThreads(int threads) {
  if (threads >= 0) return {};
  return Fail("threads = " + std::to_string(threads) + ", expected 0 (all cores) or more");
}

void ParallelFor(int count, int threads, const std::function<void(int)>& body) {
  if (threads <= 0) threads = std::max(1U, std::thread::hardware_concurrency());
  threads = kHasThreads ? std::min(threads, count) : 1;
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) body(i);
  };
  std::vector<std::thread> crew;
  for (int t = 1; t < threads; ++t) crew.emplace_back(work);
  work();
  for (std::thread& member : crew) member.join();
}

}  // namespace lyrefit
