#pragma once

#include <chrono>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The one stopwatch: const Instant begin = Now(); ... SecondsSince(begin).
using Instant = std::chrono::steady_clock::time_point;

// A moment, by a clock that nobody sets.
inline Instant Now() { return std::chrono::steady_clock::now(); }

// Seconds from `begin` to now.
inline double SecondsSince(Instant begin) {
  return std::chrono::duration<double>(Now() - begin).count();
}

}  // namespace lyrefit
