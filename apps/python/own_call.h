#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "lyrefit/base/observer.h"
#include "work.h"

// Functions of the user's own that the library calls while it works.
namespace lyrefit::python {

// Where what such a function raised waits until the work is over: the library throws nothing. The
// first one counts; from then on none is called, and the observer says stop.
class Fault {
 public:
  bool Happened() const { return happened_; }
  // Inside a catch block.
  void Keep();
  // Raises it, once; the interpreter's lock has to be held.
  void Raise();

 private:
  std::atomic<bool> happened_{false};
  std::mutex mutex_;
  std::exception_ptr first_;
};

// The faults of all that one call of a verb was given.
class Faults {
 public:
  void Add(std::shared_ptr<Fault> fault) { faults_.push_back(std::move(fault)); }
  bool empty() const { return faults_.empty(); }
  // `observer`, which says stop when something was raised.
  Observer Watched(const Observer& observer) const;
  void Raise() const;

 private:
  std::vector<std::shared_ptr<Fault>> faults_;
};

// Work() that may call such functions; what one of them raised is raised, in the place of what was
// found. The working thread keeps its state of the interpreter from one call to the next.
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
