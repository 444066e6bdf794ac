#pragma once

#include <optional>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/reading_errors.h"

namespace lyrefit {

struct WeighedFit {
  ErrorReport errors;
  std::optional<FoundErrors> found;  // none if the sizes are stated
};

// Weights the fit of `problem`, which ended at `end`, by the errors estimated from its residuals or
// by the stated ones, and refits until both are stationary. On return `problem` and `end` are the
// weighted ones. Returns none, and changes nothing, if there are too few readings to estimate
// errors.
std::optional<WeighedFit> WeighAndRefine(ErrorSpec spec, const IvCurve& curve,
                                         const ProgressReporter& progress, RefineProblem* problem,
                                         RefineEnd* end);

}  // namespace lyrefit
