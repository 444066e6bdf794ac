#pragma once

#include <functional>

#include "lyrefit/base/error.h"

namespace lyrefit {

// What options may say of threads: a number of them, or 0 for all cores.
Expected<void> CheckThreads(int threads);

// Runs body(0) .. body(count - 1) on up to `threads` threads (0: all cores) and returns when all
// are done. The bodies must be independent and write only to their own slot: then the result does
// not depend on the number of threads.
void ParallelFor(int count, int threads, const std::function<void(int)>& body);

}  // namespace lyrefit
