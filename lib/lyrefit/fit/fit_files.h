#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/fit/fit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Calls fit(i, observer) for the i-th of the files, on up to `threads` threads (0: all cores), and
// returns what came of them in the order of the files. `observer` sees how many are done; after it
// asks to stop none is begun, and those that were not are left out.
std::vector<FittedFile> FitFiles(
    const std::vector<std::string>& files, int threads, const Observer& observer,
    const std::function<Expected<FitReport>(int i, const Observer& observer)>& fit);

}  // namespace lyrefit
