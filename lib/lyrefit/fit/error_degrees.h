#pragma once

#include <functional>
#include <vector>

#include "lyrefit/refine/error_sizes.h"

namespace lyrefit {

// Standard errors of the estimates if the errors had these sizes.
using ErrorsAt = std::function<std::vector<double>(const ErrorSizes&)>;

// Degrees of freedom of each estimate's standard error, at most `most`: the sizes it rests on were
// found from the same readings, and an interval allows for that by Student's t as if its square
// were a chi-square of the same relative variance (Satterthwaite 1946, doi:10.2307/3002019).
std::vector<int> FindDegrees(const FoundErrors& found, const ErrorsAt& standard_errors, int most);

}  // namespace lyrefit
