#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

// Leaves out a test that takes long where the sanitizers make all slow, and whose code they see in others.
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

// How often to repeat what only makes a claim surer: a tenth where the sanitizers make all slow.
constexpr int Repeats(int often) { return kSanitized ? std::max(1, often / 10) : often; }

// At night (`cmake/check.sh --nightly`, which sets LYREFIT_NIGHTLY) studies run at full size.
inline bool AtNight() { return std::getenv("LYREFIT_NIGHTLY") != nullptr; }

inline int Repeats(int at_night, int by_day) { return Repeats(AtNight() ? at_night : by_day); }

}  // namespace lyrefit
