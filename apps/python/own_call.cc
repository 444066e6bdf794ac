#include "own_call.h"

#include <utility>

namespace lyrefit::python {

void Fault::Keep() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (first_ == nullptr) first_ = std::current_exception();
  happened_ = true;
}

void Fault::Raise() {
  if (!happened_) return;
  std::exception_ptr raised;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    raised = std::exchange(first_, nullptr);
    happened_ = false;
  }
  if (raised != nullptr) std::rethrow_exception(raised);
}

Observer Faults::Watched(const Observer& observer) const {
  if (faults_.empty()) return observer;
  return [observer, faults = faults_](const Progress& progress) {
    for (const auto& fault : faults) {
      if (fault->Happened()) return ObserverAction::kStop;
    }
    return observer ? observer(progress) : ObserverAction::kContinue;
  };
}

void Faults::Raise() const {
  for (const auto& fault : faults_) fault->Raise();
}

}  // namespace lyrefit::python
