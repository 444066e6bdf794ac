#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "lyrefit/base/observer.h"

namespace lyrefit::python {

// Runs `work` without the interpreter's lock. Ten times a second the lock is taken back to look for
// signals and to call `progress` (None: nobody) with a lyrefit.Progress. Where either raises, or
// `progress` returns False, the observer says stop; what was raised is raised again once the work is
// over, and what it gave is dropped. `progress` is called at least once if there was anything to
// tell.
//
// Signals reach the main thread alone, which may have nothing to do while others work: so the work
// is done on a thread beside, unless it is all done by one (`threads` is 1), whose observer hears of
// it often enough. That saves the microseconds of a thread.
void RunAside(pybind11::handle progress, int threads,
              const std::function<void(const Observer&)>& work);

// The same for work that gives something.
template <class Function>
auto Work(pybind11::handle progress, Function&& work, int threads = 0) {
  std::optional<std::invoke_result_t<Function, const Observer&>> result;
  RunAside(progress, threads, [&](const Observer& observer) { result.emplace(work(observer)); });
  return *std::move(result);
}

// Runs what is over at once without the interpreter's lock.
template <class Function>
auto Unlocked(Function&& work) {
  const pybind11::gil_scoped_release released;
  return work();
}

}  // namespace lyrefit::python
