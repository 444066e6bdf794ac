#pragma once

#include <vector>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// What can be said against a comparison without a look at its curves: nothing to compare, names
// that are missing or the same, options outside their ranges.
Expected<void> CheckComparison(const std::vector<CompareCurve>& curves,
                               const std::vector<ComparedAlgorithm>& algorithms,
                               const CompareOptions& options);

}  // namespace lyrefit
