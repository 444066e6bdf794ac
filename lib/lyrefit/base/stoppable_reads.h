// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Makes file reads interruptible. While an object lives, reads of its thread fail once `stop`
// requests it. The token is polled before every block, and ten times a second while a pipe has no
// data. It lets an observer stop a computation that is still reading.
class StoppableReads {
 public:
  // `stop` is polled only from the thread that constructs the object.
  explicit StoppableReads(StopToken stop);
  ~StoppableReads();
  StoppableReads(const StoppableReads&) = delete;             // tied to its thread
  StoppableReads& operator=(const StoppableReads&) = delete;  // tied to its thread

  // Whether a token of any object of the current thread requests a stop.
  static bool Stopped();

 private:
  StopToken stop_;
  StoppableReads* outer_;
};

}  // namespace lyrefit
