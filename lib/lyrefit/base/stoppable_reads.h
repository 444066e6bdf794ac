#pragma once

#include <functional>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Makes file reads interruptible. While an object lives, reads of its thread fail once `stopped`
// returns true. The function is called before every block, and ten times a second while a pipe has
// no data. It lets an observer stop a computation that is still reading.
class StoppableReads {
 public:
  // `stopped` is called only from the thread that constructs the object.
  explicit StoppableReads(std::function<bool()> stopped);
  ~StoppableReads();
  StoppableReads(const StoppableReads&) = delete;             // tied to its thread
  StoppableReads& operator=(const StoppableReads&) = delete;  // tied to its thread

  // Whether `stopped` of any object of the current thread returns true.
  static bool Stopped();

 private:
  std::function<bool()> stopped_;
  StoppableReads* outer_;
};

}  // namespace lyrefit
