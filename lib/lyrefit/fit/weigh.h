#pragma once

#include <optional>

#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/fit_watch.h"
#include "lyrefit/fit/reading_errors.h"

namespace lyrefit {

struct WeighedFit {
  ErrorReport errors;
  std::optional<FoundErrors> found;  // unless the sizes are stated
};

// Weighs the fit of `problem` that ended at `end` by the errors of its own residuals, or by those
// that are stated, and goes on from there until both stand still. `problem` and `end` come back as
// the weighed ones. None, and nothing is changed, where there are too few readings to find errors.
std::optional<WeighedFit> WeighAndRefine(ErrorSpec spec, const IvCurve& curve, FitWatch* watch,
                                         RefineProblem* problem, RefineEnd* end);

}  // namespace lyrefit
