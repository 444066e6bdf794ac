#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "lyrefit/base/observer.h"

namespace lyrefit::python {

// Runs `work` without the interpreter's lock. Ten times a second the lock is taken to check for
// signals and to call `progress` (may be None) with a lyrefit.Progress. If either raises, or
// `progress` returns False, the observer requests a stop. After the work the exception is raised
// again and the result is dropped. `progress` is called at least once if any progress was reported.
//
// Only the main thread handles signals, and it may be idle while others work. The work therefore
// runs on a separate thread, unless it uses a single one (`threads` is 1): its observer is then
// called often enough. That saves the microseconds of starting a thread.
void RunAside(pybind11::handle progress, int threads,
              const std::function<void(const Observer&)>& work);

// RunAside for work with a result.
template <class Function>
auto Work(pybind11::handle progress, Function&& work, int threads = 0) {
  std::optional<std::invoke_result_t<Function, const Observer&>> result;
  RunAside(progress, threads, [&](const Observer& observer) { result.emplace(work(observer)); });
  return *std::move(result);
}

// Runs short work without the interpreter's lock.
template <class Function>
auto Unlocked(Function&& work) {
  const pybind11::gil_scoped_release released;
  return work();
}

}  // namespace lyrefit::python
