#pragma once

#include <vector>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Checks a comparison without reading its curves. Errors: nothing to compare, missing or equal
// names, options outside their ranges.
Expected<void> CheckComparison(const std::vector<CompareCurve>& curves,
                               const std::vector<ComparedAlgorithm>& algorithms,
                               const CompareOptions& options);

}  // namespace lyrefit
