// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/study/compare_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Lists of algorithms for the common studies. `search` supplies population, iterations and the
// settings of the algorithms.
std::vector<ComparedAlgorithm> PlainAlgorithms(const std::vector<Algorithm>& algorithms,
                                               const SearchOptions& search);
// The algorithm named "shape" or "default", by its kind. Its search settings are fixed by the kind.
ComparedAlgorithm OwnAlgorithm(AlgorithmKind kind);
// Every algorithm with every budget of objective evaluations; the algorithm is the outer loop. The
// population is about the square root of the budget, limited to 4 to 100. Names have the form
// "mlo@420".
std::vector<ComparedAlgorithm> BudgetAlgorithms(const std::vector<Algorithm>& algorithms,
                                                const std::vector<std::int64_t>& budgets,
                                                const SearchOptions& search = {});
// `search` with the population, iterations and evaluation limit for this budget of evaluations.
SearchOptions BudgetSearch(std::int64_t budget, SearchOptions search = {});

}  // namespace lyrefit
