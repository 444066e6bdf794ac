#pragma once

#include <set>
#include <vector>

#include "lyrefit/law/device_effects.h"
#include "lyrefit/refine/active_set.h"

namespace lyrefit {

// Free parameters of one effect that are selected by trials and not by descent (the time of a step,
// the choice between two laws), and their trial values.
struct Settings {
  std::vector<int> parameters;
  std::set<std::vector<double>> values;  // one value for each parameter
};

// Settings of every effect with such parameters. The effects' parameters start at index `first`.
std::vector<Settings> FindSettings(const DeviceEffects& device_effects, int first);

// Optima besides the best one that are compatible with the data.
struct OptimumQuery {
  double highest = 0;  // mean square of the least compatible optimum, A^2
  int first = 0;       // index of the effects' first parameter
  RefineOptions how;   // options of the refits
};

// The optima below `highest` among `ends` and among refits from `best` with other settings of the
// effects. Each differs from the others in its curve or in its numbers. All in internal units.
std::vector<FitPoint> FindOtherOptima(const FitModel& model, const DeviceEffects& device_effects,
                                      const FitPoint& best, std::vector<FitPoint> ends,
                                      const OptimumQuery& query);

}  // namespace lyrefit
