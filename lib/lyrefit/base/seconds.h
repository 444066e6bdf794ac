#pragma once

#include <chrono>

namespace lyrefit {

// The one stopwatch: const Instant begin = Now(); ... SecondsSince(begin).
using Instant = std::chrono::steady_clock::time_point;

inline Instant Now() { return std::chrono::steady_clock::now(); }

inline double SecondsSince(Instant begin) {
  return std::chrono::duration<double>(Now() - begin).count();
}

}  // namespace lyrefit
