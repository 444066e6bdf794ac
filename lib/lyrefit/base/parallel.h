#pragma once

#include <functional>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// More than any machine has; what a flag takes.
constexpr int kMostThreads = 1024;

// What every `threads` among options must be: 0, all cores, or more.
Expected<void> ValidateThreads(int threads);

// Runs body(0) .. body(count - 1) on up to `threads` threads (0: all cores) and returns when all
// are done. The bodies must be independent and write only to their own slot: then the result does
// not depend on the number of threads.
void ParallelFor(int count, int threads, const std::function<void(int)>& body);

}  // namespace lyrefit
