#pragma once

#include <vector>

#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/reading_errors.h"

namespace lyrefit {

// Intervals around `end`, and from a lower optimum once more if a profile comes upon one. `ends`:
// of other fits; `degrees`: of each estimate's standard error, empty: what is left of points.
void JudgeAndImprove(FitJob* job, const RefineProblem& problem, const std::vector<FitPoint>& ends,
                     const std::vector<int>& degrees, RefineEnd* end, FitReport* report);

// What the errors of a plain fit are, and intervals under them where they are believed.
void FindIntervalsUnderErrors(FitJob* job, const std::vector<FitPoint>& ends, const RefineEnd& end,
                              FitReport* report);

// Of the standard errors of a fit that was weighed by found errors.
std::vector<int> DegreesOfWeighed(FitJob* job, const FoundErrors& found, const RefineEnd& end);

}  // namespace lyrefit
