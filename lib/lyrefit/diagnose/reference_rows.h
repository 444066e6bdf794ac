#pragma once

#include <vector>

#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/reference_comparison.h"

namespace lyrefit {

// Now against expected, quantity by quantity.
std::vector<ReferenceRow> DescribeDifference(const FittedSweep& sweep, const Expectation& expected,
                                           const Difference& difference);

// Isc per light, where the light of all is known: by the sensor, whose own scatter is in the
// references too. With the temperatures of enough sweeps it follows them. One row or none.
std::vector<ReferenceRow> DescribeLight(const SweepState& now,
                                      const std::vector<const SweepState*>& references);

}  // namespace lyrefit
