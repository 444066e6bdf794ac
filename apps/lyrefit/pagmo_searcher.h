#pragma once

#include <string>

#include "lyrefit/study/compare.h"

namespace lyrefit {

// Algorithms of pagmo2 (Biscani and Izzo 2020, doi:10.21105/joss.02338) under the conditions of
// lyrefit's searches. They search the unit box of the same search space from the same first
// candidates of (seed, run). Their budget is exactly population x (iterations + 1) or
// `max_evaluations`, whichever is less. pagmo's settings are its defaults, but early stopping is
// off. The elites are the best distinct evaluated points. `target`, `patience` and `time_limit_s`
// do not apply.

// "de, sade, ...": names allowed after "pagmo:"; empty if lyrefit was built without pagmo2.
std::string PagmoNames();

// The compared algorithm "pagmo:NAME" with the population and budget of `search`. Errors: an
// unknown name, a population that the algorithm does not accept, a build without pagmo2.
Expected<ComparedAlgorithm> PagmoAlgorithm(const std::string& name, const SearchOptions& search);

}  // namespace lyrefit
