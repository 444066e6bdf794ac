#pragma once

#include <vector>

#include "lyrefit/diagnose/expectation.h"
#include "lyrefit/diagnose/reference.h"

namespace lyrefit {

// Finds changes that would turn a reference sweep into this sweep. Each candidate change is removed
// from the readings in a small dose and the single diode is fitted again; the size is the one that
// best matches the difference. Best first, then those about as good; empty if none explains half of
// the difference.
std::vector<ReferenceCause> ExplainDifference(const FittedSweep& sweep, const Expectation& expected,
                                              const Difference& difference);

// The sets of causes that may lower the key points of a sweep together, from the rows of
// DescribeKeyPoints that differ. Of one face in one light nothing tells the members of a set apart.
std::vector<ReferenceCause> ExplainKeyPoints(const std::vector<ReferenceRow>& rows);

// The measurement that decides between the members of the sets; empty without such causes.
std::string DecidingMeasurement(const std::vector<ReferenceCause>& causes);

// One row for each quantity: value of the sweep and expected value.
std::vector<ReferenceRow> DescribeDifference(const FittedSweep& sweep, const Expectation& expected,
                                             const Difference& difference);

// Row for Isc per irradiance, by the sensor, whose own scatter is part of the references' scatter.
// It is corrected for temperature if all temperatures are known and there are eight references or
// more. Empty if an irradiance is unknown.
std::vector<ReferenceRow> DescribeLight(const SweepState& now,
                                        const std::vector<const SweepState*>& references);

// Rows for Isc per irradiance, Voc beyond what that current gives, the fill factor and the leak, in this
// order, against few references, whose own scatter is not known: that between sweeps of one module is
// taken as usual of the setup. Empty if a light or temperature is unknown, or lights differ by a fifth.
std::vector<ReferenceRow> DescribeKeyPoints(const SweepState& now,
                                            const std::vector<const SweepState*>& references);

}  // namespace lyrefit
