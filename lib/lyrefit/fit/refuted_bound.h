#pragma once

#include <string>

#include "lyrefit/fit/fit_job.h"

namespace lyrefit {

// Whether the readings refute a bound that an ideality factor sits at: `problem` is fitted again
// with more room there, and the F-test says, at 5 %, that this describes them better; where their
// errors hang together, their likelihood must say so as well. Every interval of such a fit would
// hold under a condition that is false. The reason in plain words; empty: no bound is refuted. `end`
// is the best end within the bounds.
std::string RefutedBound(FitJob* job, const RefineProblem& problem, const RefineEnd& end,
                         const FitReport& report);

}  // namespace lyrefit
