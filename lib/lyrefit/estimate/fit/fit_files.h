#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Calls fit(i, observer) for the i-th file, on up to `threads` threads (0: all cores), and returns
// the results in the order of the files. `observer` receives the number of finished files. After it
// requests a stop no further file is started; files that were not fitted are omitted from the
// result.
std::vector<FittedFile> FitFiles(
    const std::vector<std::string>& files, int threads, const Observer& observer,
    const std::function<Expected<FitReport>(int i, const Observer& observer)>& fit);

}  // namespace lyrefit
