#pragma once

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// The propagation of distributions: fills what is drawn of the outputs that AddLinearBudget left.
void AddDraws(const UncertainModel& model, const UncertaintySources& sources, int threads,
              UncertaintyBudget* budget);

}  // namespace lyrefit
