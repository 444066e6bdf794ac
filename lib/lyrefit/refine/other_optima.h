#pragma once

#include <set>
#include <vector>

#include "lyrefit/law/extension.h"
#include "lyrefit/refine/active_set.h"

namespace lyrefit {

// Parameters of one effect that are settled by trying and not by descent (the time of a step, one
// law or the other), where they are free, and what they are tried at.
struct Settings {
  std::vector<int> parameters;
  std::set<std::vector<double>> values;  // a value for each of them
};

// Of every effect that has such parameters. Those of the effects stand from `first` on.
std::vector<Settings> FindSettings(const Extension& extension, int first);

// Optima beside the best that the data may allow as well.
struct OptimumQuery {
  double highest = 0;  // mean square up to which they do
  int first = 0;       // where the effects' parameters begin
  RefineOptions how;   // of the refits
};

// Of `ends`, and of refits from `best` with other settings of the effects, those that `highest`
// allows, each with another curve or other numbers. All in numbers of the effects' own.
std::vector<FitPoint> FindOtherOptima(const FitModel& model, const Extension& extension,
                                  const FitPoint& best, std::vector<FitPoint> ends,
                                  const OptimumQuery& query);

}  // namespace lyrefit
