#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/search/search_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// Minimises `objective` over the box. The same seed and run give the same bits. Options and box
// must be valid (CHECKed). A search that ends early is a result, not an error: see `termination`.
SearchSummary Search(const ObjectiveFunction& objective, const Box& box,
                     const SearchOptions& options, const Observer& observer = {});

// The candidates from which every algorithm of Search() but kMloShape starts in this seed and run:
// `population` points, uniform in the box.
std::vector<std::vector<double>> FirstPopulation(const Box& box, const SearchOptions& options);

}  // namespace lyrefit
