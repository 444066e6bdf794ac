#pragma once

#include <string>

#include "batch/strings.h"
#include "plant/additions.h"

namespace lyrefit {

// Options of a run with all additions.
inline BatchOptions IntoPlant(const std::string& folder, int threads = 2,
                              const PlantOptions& comparisons = {},
                              PlantResults* results = nullptr) {
  BatchOptions options = Into(folder, threads);
  options.additions = PlantAdditions(comparisons, results);
  return options;
}

// Options of a merge with all additions.
inline MergeOptions MergedInto(const std::string& folder, PlantResults* results = nullptr) {
  return {folder, false, PlantAdditions({}, results)};
}

}  // namespace lyrefit
