#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "lyrefit/base/observer.h"
#include "work.h"

// Support for Python functions that the library calls during its work.
namespace lyrefit::python {

// Stores the exception of such a function until the work is over, since the library throws none.
// Only the first one is kept. After it no function is called, and the observer requests a stop.
class Fault {
 public:
  bool Happened() const { return happened_; }
  // Stores the current exception; call it inside a catch block.
  void Keep();
  // Raises the exception, once. The caller must hold the interpreter's lock.
  void Raise();

 private:
  std::atomic<bool> happened_{false};
  std::mutex mutex_;
  std::exception_ptr first_;
};

// The faults of all functions passed to one call of a verb.
class Faults {
 public:
  void Add(std::shared_ptr<Fault> fault) { faults_.push_back(std::move(fault)); }
  bool empty() const { return faults_.empty(); }
  // Wraps `observer`; requests a stop after an exception.
  Observer Watched(const Observer& observer) const;
  void Raise() const;

 private:
  std::vector<std::shared_ptr<Fault>> faults_;
};

// Work() for functions that may call Python. Raises their exception instead of returning the
// result. The working thread keeps its interpreter state between calls.
template <class Function>
auto WorkWith(const Faults& faults, pybind11::handle progress, Function&& work, int threads = 0) {
  const auto watched = [&](const Observer& observer) {
    if (faults.empty()) return work(observer);
    const pybind11::gil_scoped_acquire state;
    const pybind11::gil_scoped_release unlocked;
    return work(faults.Watched(observer));
  };
  auto result = Work(progress, watched, threads);
  faults.Raise();
  return result;
}

}  // namespace lyrefit::python
