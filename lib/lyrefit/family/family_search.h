#pragma once

#include <vector>

#include "lyrefit/family/family_problem.h"

namespace lyrefit {

// Result of the search over the shared parameters, on the search curves.
struct FamilySearchEnd {
  SearchSummary summary;
  std::vector<JointPoint> elites;  // best first; the curves' own unknowns are 0
  JointPoint random;               // best of as many random points, if requested
  bool has_random = false;
};

// Runs the search. Error: a search of the caller returned no candidate, or one that is not finite
// or is outside the box.
Expected<FamilySearchEnd> SearchFamily(const FamilyProblem& family, const FamilyOptions& options,
                                       const std::vector<int>& curves, const Observer& observer);

// Unweighted root mean square of both residuals over all points of all curves. `point.local` has
// one entry for each curve of the problem.
RmsePair FamilyRmse(const JointProblem& problem, const JointPoint& point);

// Unweighted RMSE of curve number `curve` of the problem.
RmsePair CurveRmse(const JointProblem& problem, const JointPoint& point, int curve);

}  // namespace lyrefit
