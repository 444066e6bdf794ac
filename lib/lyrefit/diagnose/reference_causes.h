#pragma once

#include <vector>

#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/reference_comparison.h"

namespace lyrefit {

// What, done to a reference sweep, makes this difference: each candidate is done to the sweep in a
// small dose, which is fitted anew, and its size is what comes nearest to the difference. The best
// first, then those that explain it about as well; empty where none explains half of it.
std::vector<ReferenceCause> ExplainDifference(const FittedSweep& sweep, const Expectation& expected,
                                            const Difference& difference);

}  // namespace lyrefit
