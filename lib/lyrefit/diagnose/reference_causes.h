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

// The sets of causes that may lower the key points of a sweep together, from the rows of
// DescribeKeyPoints that differ. Of one face in one light nothing tells the members of a set apart.
std::vector<ReferenceCause> ExplainKeyPoints(const std::vector<ReferenceRow>& rows);

// The measurement that decides between the members of the sets; empty without such causes.
std::string DecidingMeasurement(const std::vector<ReferenceCause>& causes);

}  // namespace lyrefit
