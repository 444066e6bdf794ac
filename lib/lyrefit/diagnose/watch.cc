#include "lyrefit/diagnose/watch.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>

namespace lyrefit {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPeriod(20);

}  // namespace

struct Watch::State {
  Observer observer;
  std::mutex mutex;  // of all below but `stopped`
  Progress progress;
  Clock::time_point begun = Clock::now();
  Clock::time_point asked = {};
  std::atomic<bool> stopped{false};

  void Ask(Clock::time_point now) {
    asked = now;
    progress.seconds = std::chrono::duration<double>(now - begun).count();
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
  state_->begun = Clock::now();
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
  if (!lock.owns_lock()) return state_->stopped;     // another thread is asking
  if (state_->progress.stage.empty()) return false;  // nothing has begun
  const Clock::time_point now = Clock::now();
  if (now - state_->asked >= kPeriod) state_->Ask(now);
  return state_->stopped;
}

}  // namespace lyrefit
