#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// Checks and completes the result of a user's own search before the polish. `best` replaces missing
// elites, the first elite replaces a missing `best`, and objective values are recomputed. Error: no
// candidate, or one that is not finite, is outside the box or has another number of coordinates
// than the box.
Expected<void> CheckCandidates(const ObjectiveFunction& objective, const Box& box,
                               SearchSummary* summary);

}  // namespace lyrefit
