#pragma once

#include <functional>
#include <vector>

#include "lyrefit/estimate/refine/error_sizes.h"

namespace lyrefit {

// Standard errors of the estimates as a function of the error sizes.
using ErrorsAt = std::function<std::vector<double>(const ErrorSizes&)>;

// Degrees of freedom of each estimate's standard error, at most `most`. The error sizes were
// estimated from the same readings. Student's t accounts for that as if the squared standard error
// were a scaled chi-square of equal relative variance (Satterthwaite 1946, doi:10.2307/3002019).
std::vector<int> FindDegrees(const FoundErrors& found, const ErrorsAt& standard_errors, int most);

}  // namespace lyrefit
