#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/search/search_options.h"
#include "lyrefit/study/compare_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Algorithms for the common studies. `search` gives population, iterations and the settings of the
// algorithms.
std::vector<ComparedAlgorithm> PlainAlgorithms(const std::vector<Algorithm>& algorithms,
                                       const SearchOptions& search);
// MLO at every Pm and gamma, Pm the outer loop. Names read "Pm=0.5 gamma=0.25".
std::vector<ComparedAlgorithm> SensitivityAlgorithms(const std::vector<double>& memory_rates,
                                             const std::vector<double>& distance_coefficients,
                                             const SearchOptions& search);
// "shape" and "default", by their kind; what they search with is set by themselves.
ComparedAlgorithm OwnAlgorithm(AlgorithmKind kind);
// Every algorithm with every budget of evaluations, the algorithm the outer loop. The population is
// about the root of the budget, 4 to 100. Names read "mlo@420".
std::vector<ComparedAlgorithm> BudgetAlgorithms(const std::vector<Algorithm>& algorithms,
                                        const std::vector<std::int64_t>& budgets,
                                        const SearchOptions& search = {});
// `search` with population, iterations and the limit of evaluations that such a budget gets.
SearchOptions BudgetSearch(std::int64_t budget, SearchOptions search = {});

}  // namespace lyrefit
