#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

// Skips a test that takes long under sanitizers and whose code other tests run under sanitizers.
#ifdef LYREFIT_SANITIZED
#define SKIP_IF_SANITIZED() \
  GTEST_SKIP() << "takes long under sanitizers, which see its code in other tests"
#else
#define SKIP_IF_SANITIZED() static_cast<void>(0)
#endif

namespace lyrefit {

#ifdef LYREFIT_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// Number of repeats where more repeats only make a test more certain: a tenth under sanitizers,
// which are slow.
constexpr int Repeats(int often) { return kSanitized ? std::max(1, often / 10) : often; }

// Whether the tests run at full size (`cmake/check.sh --nightly`, which sets LYREFIT_NIGHTLY).
inline bool AtNight() { return std::getenv("LYREFIT_NIGHTLY") != nullptr; }

inline int Repeats(int at_night, int by_day) { return Repeats(AtNight() ? at_night : by_day); }

}  // namespace lyrefit
