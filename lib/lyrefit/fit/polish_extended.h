#pragma once

#include <vector>

#include "lyrefit/fit/descents.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit {

// Polish of a device with effects, which has many local optima, in three stages. (1) Starts are the
// best candidate and the shape of the curve, and probes for effects without a shape. (2) If the
// best optimum was reached only once, further elites follow. Random points follow if that is still
// so or its residuals are not noise. (3) Neighbours of the best end: other integers, other
// settings, single parameters moved. Selects the variant of the best end.
PolishResult PolishExtended(const std::vector<PolishStart>& candidates, const SearchSpace& space,
                            FitJob* job, FitReport* report);

}  // namespace lyrefit
