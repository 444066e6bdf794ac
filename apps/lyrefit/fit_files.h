#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

// Calls fit(file, observer) for every file, on up to `threads` threads (0: all cores), and returns
// what came of them in the order of the files. `observer` sees how many are done; after it asks to
// stop none is begun, and those that were not are left out.
std::vector<FittedFile> FitFiles(
    const std::vector<std::string>& files, int threads, const Observer& observer,
    const std::function<Expected<FitReport>(const std::string& file, const Observer& observer)>&
        fit);

}  // namespace lyrefit
