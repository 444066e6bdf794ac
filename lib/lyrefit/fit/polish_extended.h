#pragma once

#include <vector>

#include "lyrefit/fit/polish.h"

namespace lyrefit {

// Starts of a device with effects: the best bird and further elites as they are, then the device
// without them, polished, with each of the effects' probes beside it, the best by their error.
// `usual` holds what the effects' parameters are where a probe does not say.
std::vector<PolishStart> CollectExtendedStarts(const RefineProblem& problem,
                                               const std::vector<std::vector<double>>& elites);

// Every start comes some steps far; those near the best of them are solved to the end.
PolishResult PolishExtended(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                            FitWatch* watch);

}  // namespace lyrefit
