#pragma once

#include <vector>

#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/reading_errors.h"

namespace lyrefit {

// Finds intervals around `end`. If a profile finds a lower optimum, the polish restarts there and
// the intervals are found again. `ends`: other local optima. `degrees`: degrees of freedom of each
// standard error; empty: readings minus free parameters.
void JudgeAndImprove(FitJob* job, const RefineProblem& problem, const std::vector<FitPoint>& ends,
                     const std::vector<int>& degrees, RefineEnd* end, FitReport* report);

// Estimates the errors of a least-squares fit, and finds intervals under them if they are believed
// (kGainToBelieve).
void FindIntervalsUnderErrors(FitJob* job, const std::vector<FitPoint>& ends, const RefineEnd& end,
                              FitReport* report);

// Degrees of freedom of the standard errors of a fit that is weighted by estimated errors.
std::vector<int> DegreesOfWeighed(FitJob* job, const FoundErrors& found, const RefineEnd& end);

}  // namespace lyrefit
