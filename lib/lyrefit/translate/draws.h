#pragma once

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// Propagates the distributions by Monte Carlo (JCGM 101). Fills `drawn`, `samples` and
// `failed_draws` of the outputs that AddLinearBudget created. If `observer` stops it, they stay
// empty and the budget's `draws` becomes 0.
void AddDraws(const UncertainModel& model, const UncertaintySources& sources, int threads,
              const Observer& observer, UncertaintyBudget* budget);

}  // namespace lyrefit
