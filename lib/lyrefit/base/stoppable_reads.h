#pragma once

#include <functional>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// While it lives, what this thread reads from files ends with an error once `stopped` says so. It is
// asked at every block, and ten times a second while a pipe has nothing to give. For an observer
// that may want to stop while there is still something to be read.
class StoppableReads {
 public:
  // `stopped` is called from this thread alone.
  explicit StoppableReads(std::function<bool()> stopped);
  ~StoppableReads();
  StoppableReads(const StoppableReads&) = delete;             // it belongs to a thread
  StoppableReads& operator=(const StoppableReads&) = delete;  // it belongs to a thread

  // Whether any that lives in this thread says so.
  static bool Stopped();

 private:
  std::function<bool()> stopped_;
  StoppableReads* outer_;
};

}  // namespace lyrefit
