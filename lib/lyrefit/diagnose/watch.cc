#include "lyrefit/diagnose/watch.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>

#include "lyrefit/base/seconds.h"

namespace lyrefit {
namespace {

constexpr std::chrono::milliseconds kPeriod(20);

}  // namespace

struct Watch::State {
  Observer observer;
  std::mutex mutex;  // guards everything below except `stopped`
  Progress progress;
  Instant begun = Now();
  Instant asked = {};
  std::atomic<bool> stopped{false};

  void Ask(Instant now) {
    asked = now;
    progress.seconds = SecondsSince(begun);
    if (StopRequested(observer, progress)) stopped = true;
  }
};

Watch::Watch(Observer observer) : state_(new State) { state_->observer = std::move(observer); }
Watch::~Watch() = default;

void Watch::Begin(const char* name, std::int64_t steps) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->progress.stage = name;
  state_->progress.iteration = 0;
  state_->progress.iterations = steps;
  state_->begun = Now();
  state_->Ask(state_->begun);
}

void Watch::Step() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  Progress& progress = state_->progress;
  if (progress.iteration < progress.iterations) ++progress.iteration;
}

bool Watch::Stopped() {
  if (state_->stopped || !state_->observer) return state_->stopped;
  const std::unique_lock<std::mutex> lock(state_->mutex, std::try_to_lock);
  if (!lock.owns_lock()) return state_->stopped;     // another thread calls the observer
  if (state_->progress.stage.empty()) return false;  // before the first stage
  const Instant now = Now();
  if (now - state_->asked >= kPeriod) state_->Ask(now);
  return state_->stopped;
}

}  // namespace lyrefit
