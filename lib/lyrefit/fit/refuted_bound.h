#pragma once

#include <string>

#include "lyrefit/fit/fit_job.h"

namespace lyrefit {

// Tests whether the readings refute a bound at which an ideality factor is active. `problem` is
// fitted again with a wider range, and the F-test decides at 5 % whether that describes the
// readings better. If their errors are correlated, the likelihood under those errors must agree.
// Every interval of a refuted fit would be conditional on a false assumption. Returns the reason as
// a sentence; empty: no bound is refuted. `end` is the best end within the bounds.
std::string RefutedBound(FitJob* job, const RefineProblem& problem, const RefineEnd& end,
                         const FitReport& report);

}  // namespace lyrefit
