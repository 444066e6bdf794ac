#pragma once

#include "lyrefit/fit/fit.h"

namespace lyrefit {

// Cross-validated RMSE of a polished fit, in ampere and of the objective that was fitted: the points, in
// order of voltage, are cut into contiguous blocks; each is left out in turn, the model is refitted to
// the rest, and its residuals on the block are counted. NaN where too few points are left to refit.
// Contiguous blocks, since residuals of neighbours are alike and single points would be too easy.
double HeldOutRmse(const FitReport& report, const FitOptions& options);

}  // namespace lyrefit
