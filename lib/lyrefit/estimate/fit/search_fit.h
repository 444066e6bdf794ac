#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/search_space.h"

namespace lyrefit {

// Second stage of a fit: the search and its best candidates.
struct SearchedFit {
  SearchSummary summary;
  std::vector<PolishStart> candidates;      // best first; at least one
  std::int64_t curve_evaluations = 0;       // see FitReport
  std::optional<RmsePair> random_baseline;  // best of as many random points, if requested
};

// Searches `space`, which is SpaceOf(fit). Error: a user's own search gave no valid candidate.
Expected<SearchedFit> SearchFit(const PreparedFit& fit, const SearchSpace& space,
                                const Observer& observer, const ProgressReporter& progress);

}  // namespace lyrefit
