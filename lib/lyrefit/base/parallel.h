// Experimental: may change in a minor version (data/stable).
#pragma once

#include <functional>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Upper limit of thread-count flags, more than any machine has.
constexpr int kMostThreads = 1024;

// Checks a `threads` option: 0 (all cores) or more, otherwise an error.
Expected<void> ValidateThreads(int threads);

// Calls body(0) .. body(count - 1) on up to `threads` threads (0: all cores) and returns when all
// calls have returned. The calls must be independent and write only to their own slot; then the
// result does not depend on the number of threads.
void ParallelFor(int count, int threads, const std::function<void(int)>& body);

}  // namespace lyrefit
