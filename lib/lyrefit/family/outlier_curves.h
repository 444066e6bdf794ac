#pragma once

#include <functional>
#include <vector>

#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Positions among the problem's curves of those that do not belong to the device of the others: a
// fit that hardly listens to them misses them by far more than it misses the rest, and visibly, and
// more than an ordinary error of their readings explains. `proceed` is asked as in JointOptions;
// what comes back after it said no says nothing.
std::vector<int> FindOutlierCurves(const JointProblem& problem, const JointEnd& end,
                               const std::function<bool()>& proceed = {});

}  // namespace lyrefit
