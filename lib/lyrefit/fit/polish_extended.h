#pragma once

#include <vector>

#include "lyrefit/fit/basins.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit {

// The hybrid over the basins of a device with effects. It begins where the shape of the curve
// suggests, at the best bird and further elites, and at probes of what shows in no shape; goes on
// from random places, where these have not come to the best basin more than once; and last tries
// the whole numbers next to those of the best. Settles for the form of the best end.
PolishResult PolishExtended(const std::vector<PolishStart>& birds, const SearchSpace& space,
                            FitJob* job, FitReport* report);

}  // namespace lyrefit
