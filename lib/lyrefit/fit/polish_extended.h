#pragma once

#include <vector>

#include "lyrefit/fit/descents.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit {

// The hybrid over the local optima of a device with effects. It begins where the shape of the curve
// suggests, at the best candidate and at probes of what shows in no shape; goes on from further elites
// where the best local optimum was reached once, and from random places where that is still so or where
// its residuals are no noise; and last tries what is next to the best end: other whole numbers,
// other settings, single parameters elsewhere. Settles for the variant of the best end.
PolishResult PolishExtended(const std::vector<PolishStart>& candidates, const SearchSpace& space,
                            FitJob* job, FitReport* report);

}  // namespace lyrefit
