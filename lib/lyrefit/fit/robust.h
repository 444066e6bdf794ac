#pragma once

#include <functional>

#include "lyrefit/fit/fit_options.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// Reweights for the robust loss of `options` until the weights stand still (at most 50 rounds).
// `problem` comes back as the weighted problem whose least-squares solution, `end`, is the robust
// estimate, so that everything that follows needs to know of weights alone. Ends where it stands
// once `stop` says so.
void Robustify(const FitOptions& options, const std::function<bool()>& stop, RefineProblem* problem,
               RefineEnd* end);

}  // namespace lyrefit
