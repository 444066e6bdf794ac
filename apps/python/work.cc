#include "work.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace lyrefit::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kPeriod(100);  // between two checks

// A progress report with copies of its texts.
struct HeardProgress {
  Progress progress;
  std::string stage;
  std::string note;
};

// Messages between the working thread and the waiting one.
class Exchange {
 public:
  ObserverAction Hear(const Progress& progress) {
    if (listened_) {
      const std::lock_guard<std::mutex> lock(mutex_);
      news_ = HeardProgress{progress, std::string(progress.stage), std::string(progress.note)};
    }
    return Action();
  }
  ObserverAction Action() const {
    return stop_ ? ObserverAction::kStop : ObserverAction::kContinue;
  }

  void Finish(std::exception_ptr thrown) {
    // Notifies under the lock: the waiting thread may destroy this object as soon as it gets the
    // lock.
    const std::lock_guard<std::mutex> lock(mutex_);
    thrown_ = std::move(thrown);
    finished_ = true;
    done_.notify_one();
  }

  bool WaitForEnd() {
    std::unique_lock<std::mutex> lock(mutex_);
    return done_.wait_for(lock, kPeriod, [this] { return finished_; });
  }

  std::optional<HeardProgress> News() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(news_, std::nullopt);
  }

  void Listen() { listened_ = true; }
  void Stop() { stop_ = true; }
  const std::exception_ptr& thrown() const { return thrown_; }

 private:
  bool listened_ = false;  // set before the work starts
  std::atomic<bool> stop_{false};
  std::mutex mutex_;  // guards the members below
  std::optional<HeardProgress> news_;
  bool finished_ = false;
  std::exception_ptr thrown_;
  std::condition_variable done_;
};

py::object ProgressObject(const HeardProgress& heard) {
  static const py::handle type =
      py::object(py::module_::import("lyrefit").attr("Progress")).release();
  const Progress& p = heard.progress;
  return type(heard.stage, p.iteration, p.iterations, p.evaluations, p.best, p.seconds, p.part,
              heard.note);
}

// Calls `progress`; false if it requests a stop.
bool Tell(py::handle progress, const HeardProgress& heard) {
  const py::object answer = progress(ProgressObject(heard));
  return answer.ptr() != Py_False;
}

// Checks for signals and reports progress, unless a stop was requested; stores exceptions.
void Look(py::handle progress, Exchange* exchange, std::optional<py::error_already_set>* raised) {
  if (*raised) return;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none() || exchange->Action() == ObserverAction::kStop) return;
    const std::optional<HeardProgress> news = exchange->News();
    if (news && !Tell(progress, *news)) exchange->Stop();
  } catch (py::error_already_set& error) {
    raised->emplace(std::move(error));
    exchange->Stop();
  }
}

using Job = std::function<void(const Observer&)>;

void WorkBeside(py::handle progress, const Job& work, Exchange* exchange,
                std::optional<py::error_already_set>* raised) {
  const py::gil_scoped_release released;
  std::thread worker([&] {
    std::exception_ptr thrown;
    try {
      work([exchange](const Progress& news) { return exchange->Hear(news); });
    } catch (...) {
      thrown = std::current_exception();
    }
    exchange->Finish(thrown);
  });
  while (!exchange->WaitForEnd()) {
    const py::gil_scoped_acquire acquired;
    Look(progress, exchange, raised);
  }
  worker.join();
}

void WorkHere(py::handle progress, const Job& work, Exchange* exchange,
              std::optional<py::error_already_set>* raised) {
  const py::gil_scoped_release released;
  const std::thread::id here = std::this_thread::get_id();
  auto looked = std::chrono::steady_clock::now();
  work([&](const Progress& news) {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked < kPeriod || std::this_thread::get_id() != here) return exchange->Hear(news);
    looked = now;
    exchange->Hear(news);
    const py::gil_scoped_acquire acquired;
    Look(progress, exchange, raised);
    return exchange->Action();
  });
}

}  // namespace

void RunAside(py::handle progress, int threads, const Job& work) {
  Exchange exchange;
  if (!progress.is_none()) exchange.Listen();
  std::optional<py::error_already_set> raised;
  (threads == 1 ? WorkHere : WorkBeside)(progress, work, &exchange, &raised);
  Look(progress, &exchange, &raised);
  if (raised) throw std::move(*raised);
  if (exchange.thrown()) std::rethrow_exception(exchange.thrown());
}

}  // namespace lyrefit::python
