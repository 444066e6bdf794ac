#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// Makes what a search of the user's own came back with fit for the polish: `best` stands in for
// missing elites and the first elite for a missing `best`, objective values are computed anew.
// Error: no candidate at all, a candidate with another number of coordinates than the box has sides, one that
// is not finite or outside the box.
Expected<void> CheckCandidates(const ObjectiveFunction& objective, const Box& box,
                          SearchSummary* summary);

}  // namespace lyrefit
