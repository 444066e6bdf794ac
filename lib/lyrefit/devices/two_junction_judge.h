#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/devices/two_junction_problem.h"
#include "lyrefit/devices/two_junction_report.h"
#include "lyrefit/estimate/refine/active_set.h"

namespace lyrefit {

// A refined fit to be judged.
struct TwoJunctionEnd {
  RefineEnd best;
  std::vector<FitPoint> other_optima;  // ends of other starts that may fit as well
};

// Standard errors, intervals and identifiability of all parameters, and the measurements that would
// decide. Moves `end` to a lower optimum that a profile finds.
void JudgeTwoJunctions(const PreparedTwoJunctions& prepared, const TwoJunctionOptions& options,
                       const std::vector<double>& searched, const ProgressReporter& progress,
                       TwoJunctionEnd* end, TwoJunctionReport* report);

}  // namespace lyrefit
