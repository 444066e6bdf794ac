#pragma once

#include <vector>

#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {

// Settings are the free parameters of effects that are selected by trials and not by descent (the
// time of a step, the choice between two laws).

// Marks the settings that cannot be found by descent, since no residual depends on them locally at
// `at`. An example is the moment of a step between two readings.
std::vector<bool> FindFlatSettings(const FitModel& model, const EffectSpan& effects,
                                   const FitPoint& at);

// Optima besides the best one that are compatible with the data.
struct OptimumQuery {
  double highest = 0;  // mean square of the least compatible optimum, A^2
  RefineOptions how;   // options of the refits
};

// The optima below `highest` among `ends` and among refits from `best` with other settings of the
// effects. Each differs from the others in its curve or in its numbers. All in internal units.
std::vector<FitPoint> FindOtherOptima(const FitModel& model, const EffectSpan& effects,
                                      const FitPoint& best, std::vector<FitPoint> ends,
                                      const OptimumQuery& query);

}  // namespace lyrefit
