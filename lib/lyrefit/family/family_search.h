#pragma once

#include <vector>

#include "lyrefit/family/family_problem.h"

namespace lyrefit {

// What the search over the shared parameters found, on the curves it saw.
struct FamilySearchEnd {
  SearchSummary summary;
  std::vector<JointPoint> elites;  // best first; the curves' own unknowns at 0
  JointPoint random;               // best of as many random points, if asked for
  bool has_random = false;
};

// Error: a search of the user's own came back with what is no candidate of the box.
Expected<FamilySearchEnd> SearchFamily(const FamilyProblem& family, const FamilyOptions& options,
                                       const std::vector<int>& curves, const Observer& observer);

// Root mean square of both residuals over all points of the given curves, unweighted. `local` holds
// one entry for each of them.
RmsePair FamilyRmse(const JointProblem& problem, const JointPoint& point);

// The same for one curve of the problem.
RmsePair CurveRmse(const JointProblem& problem, const JointPoint& point, int curve);

}  // namespace lyrefit
