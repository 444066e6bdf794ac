#pragma once

#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/fit_watch.h"

namespace lyrefit {

// Cross-validated RMSE of a polished fit, in ampere and of the objective that was fitted: the
// points, in order of voltage, are cut into ten contiguous blocks (fewer for short curves); each is
// left out in turn, the model is refitted to the rest, and its residuals on the block are counted.
// NaN where too few points are left to refit. Contiguous blocks, since residuals of neighbours are
// alike and single points would be too easy; the first and the last point always stay in, since
// beyond them every model is guessing. Refits see Coarsen() of the rest. NaN, too, once `watch` asks
// to stop.
double HeldOutRmse(const FitReport& report, const FitOptions& options, FitWatch* watch = nullptr);

}  // namespace lyrefit
