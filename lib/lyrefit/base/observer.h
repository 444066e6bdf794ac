#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Progress of a long computation. Progress bars, time limits and Ctrl-C are implemented as
// observers.
struct Progress {
  std::string_view stage;        // "search", "polish", "intervals"
  std::int64_t iteration = 0;    // of this stage, from 1
  std::int64_t iterations = 0;   // planned for this stage; 0: unknown
  std::int64_t evaluations = 0;  // of the objective so far
  double best = 0;               // best objective value so far, in the objective's unit
  double seconds = 0;            // since the stage began
  double lower_bound = 0;        // proven lower bound of `best`, if the stage computes one
  double part = 0;  // finished fraction of the stage's work, if iterations differ in size; 0: they
                    // do not
  std::string_view note = {};  // further text to display: "702 a second, 12 broken"
};

enum class ObserverAction { kContinue, kStop };  // Whether a computation continues.

// A callback, called at most once an iteration and from one thread at a time. kStop ends the
// computation cleanly: the result so far is returned and marked as interrupted. An empty observer
// never stops a computation.
using Observer = std::function<ObserverAction(const Progress&)>;

// Whether the observer requests a stop; false for an empty observer.
inline bool StopRequested(const Observer& observer, const Progress& progress) {
  return observer && observer(progress) == ObserverAction::kStop;
}

// A request to end a computation. Copies share it. The default token never requests a stop.
class StopToken {
 public:
  StopToken() = default;
  // Without a request, Stopped() calls `poll`; true is a request. A token that several threads poll
  // needs a thread-safe `poll`. Empty: only Request() makes a request.
  explicit StopToken(std::function<bool()> poll);

  bool Stopped() const;    // polls; true: end the computation
  bool requested() const;  // whether there was a request so far; does not poll
  void Request() const;    // not for the default token
  // An observer that ignores the progress and forwards the request.
  Observer AsObserver() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

// Reports the progress of a computation to an observer and holds its request to stop. Thread-safe:
// the observer is called from one thread at a time, and not again after its request. Copies share
// one state. The default reporter reports to nobody.
class ProgressReporter {
 public:
  ProgressReporter() = default;
  // Polls of the token call the observer if its last call was at least `period_s` seconds ago.
  // `observer` must outlive the reporter, and the reporter its token.
  explicit ProgressReporter(const Observer& observer, double period_s = 0.05);
  // A reporter that begins its first stage.
  ProgressReporter(const Observer& observer, std::string_view stage, std::int64_t steps);

  // Begins a stage of `steps` steps (0: unknown) and reports it. `stage` must outlive the reporter.
  void Begin(std::string_view stage, std::int64_t steps) const;
  // The same without a report. `work` is the total over all steps, in any unit, if steps differ in
  // size; 0: they do not.
  void BeginSilently(std::string_view stage, std::int64_t steps, double work = 0) const;
  // Counts a step without a report.
  void Count(double work = 0, std::int64_t evaluations = 0) const;
  // Counts a step and reports it. True: stop.
  bool Step(double work = 0, std::int64_t evaluations = 0) const;
  // Reports the present counts. True: stop.
  bool Report() const;
  // Reports other figures than those counted here; the seconds are filled in. True: stop.
  bool Report(Progress progress) const;

  // Polls whether the observer requests a stop.
  bool Stopped() const { return stop().Stopped(); }
  const StopToken& stop() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace lyrefit
