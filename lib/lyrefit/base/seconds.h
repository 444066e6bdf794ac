// Experimental: may change in a minor version (data/stable).
#pragma once

#include <chrono>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A point in time. To measure: const Instant begin = Now(); ... SecondsSince(begin).
using Instant = std::chrono::steady_clock::time_point;

// The current time of the monotonic clock.
inline Instant Now() { return std::chrono::steady_clock::now(); }

// Elapsed time from `begin` to now, in s.
inline double SecondsSince(Instant begin) {
  return std::chrono::duration<double>(Now() - begin).count();
}

}  // namespace lyrefit
