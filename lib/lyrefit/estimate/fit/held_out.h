#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {

// Cross-validated RMSE of a polished fit, in ampere, for the fitted objective. The points, in order
// of voltage, are cut into ten contiguous blocks (fewer for short curves). Each block is left out
// in turn, the model is refitted to the rest, and the residuals on the block are counted. Blocks
// are contiguous because residuals of neighbours are correlated and single points would be too easy
// to predict. The first and the last point are never left out, since models extrapolate poorly.
// Refits use Coarsen() of the rest. NaN: too few points for a refit, or the observer requested a
// stop.
double HeldOutRmse(const FitReport& report, const FitOptions& options,
                   const ProgressReporter& progress = {});

}  // namespace lyrefit
