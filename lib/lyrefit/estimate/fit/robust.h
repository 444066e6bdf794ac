#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {

// Reweights iteratively for the robust loss of `options` until the parameters are stationary (at
// most 50 rounds). On return `problem` is the weighted problem whose least-squares solution, `end`,
// is the robust estimate, so later stages only need the weights. Returns early at a stop.
void Robustify(const FitOptions& options, const StopToken& stop, RefineProblem* problem,
               RefineEnd* end);

}  // namespace lyrefit
