#pragma once

#include <vector>

#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/reference_comparison.h"

namespace lyrefit {

// One row for each quantity: value of the sweep and expected value.
std::vector<ReferenceRow> DescribeDifference(const FittedSweep& sweep, const Expectation& expected,
                                             const Difference& difference);

// Row for Isc per irradiance, by the sensor, whose own scatter is part of the references' scatter.
// It is corrected for temperature if all temperatures are known and there are eight references or
// more. Empty if an irradiance is unknown.
std::vector<ReferenceRow> DescribeLight(const SweepState& now,
                                        const std::vector<const SweepState*>& references);

}  // namespace lyrefit
