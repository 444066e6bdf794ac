#pragma once

#include <vector>

#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/reference_comparison.h"

namespace lyrefit {

// Finds changes that would turn a reference sweep into this sweep. Each candidate change is removed
// from the readings in a small dose and the single diode is fitted again; the size is the one that
// best matches the difference. Best first, then those about as good; empty if none explains half of
// the difference.
std::vector<ReferenceCause> ExplainDifference(const FittedSweep& sweep, const Expectation& expected,
                                              const Difference& difference);

}  // namespace lyrefit
