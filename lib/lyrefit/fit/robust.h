#pragma once

#include "lyrefit/fit/fit.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// Reweights for the robust loss of `options` until the weights stand still (at most 50 rounds).
// `problem` comes back as the weighted problem whose least-squares solution, `end`, is the robust
// estimate, so that everything that follows needs to know of weights alone.
void Robustify(const FitOptions& options, RefineProblem* problem, RefineEnd* end);

}  // namespace lyrefit
