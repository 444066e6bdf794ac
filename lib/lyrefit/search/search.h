#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// Minimises `objective` over the box. Same seed and run, same bits. Options must be valid and the
// box sound (CHECKed); a search that stops early is a result, see `termination`.
SearchSummary Search(const ObjectiveFunction& objective, const Box& box,
                     const SearchOptions& options, const Observer& observer = {});

}  // namespace lyrefit
