#pragma once

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// The propagation of distributions: fills what is drawn of the outputs that AddLinearBudget left.
// Where it is stopped nothing is, and the budget's `draws` are 0.
void AddDraws(const UncertainModel& model, const UncertaintySources& sources, int threads,
              const Observer& observer, UncertaintyBudget* budget);

}  // namespace lyrefit
