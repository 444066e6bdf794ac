#pragma once

#include <string>

#include "lyrefit/study/compare.h"

namespace lyrefit {

// Algorithms of pagmo2 (Biscani and Izzo 2020, doi:10.21105/joss.02338) as algorithms, on lyrefit's
// terms: the unit box of the same search space, the same first candidates as ours from (seed, run), and
// exactly population x (iterations + 1) evaluations or `max_evaluations`, whichever is less.
// pagmo's own settings are its defaults, but for stopping early, which is switched off. The elites
// are the best distinct points that were evaluated. `target`, `patience` and `time_limit_s` do not
// apply.

// "de, sade, ...": what may stand behind "pagmo:"; empty where pagmo2 was not found when lyrefit
// was built.
std::string PagmoNames();

// The compared "pagmo:NAME" with the population and budget of `search`. Errors: an unknown name, a
// population that the algorithm does not take, a build without pagmo2.
Expected<ComparedAlgorithm> PagmoAlgorithm(const std::string& name, const SearchOptions& search);

}  // namespace lyrefit
