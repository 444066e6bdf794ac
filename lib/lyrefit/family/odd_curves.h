#pragma once

#include <vector>

#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Positions among the problem's curves of those that do not belong to the device of the others: a
// fit that hardly listens to them misses them by far more than it misses the rest, and visibly, and
// more than an ordinary error of their readings explains.
std::vector<int> FindOddCurves(const JointProblem& problem, const JointEnd& end);

}  // namespace lyrefit
