#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {

// Finds curves that do not belong to the device of the others (positions among the problem's
// curves). A robust fit misses such a curve by far more than the other curves, by a visible amount,
// and by more than ordinary errors of its irradiance and temperature explain. `stop` is polled
// as in JointOptions; after a stop the result is meaningless.
std::vector<int> FindOutlierCurves(const JointProblem& problem, const JointEnd& end,
                                   const StopToken& stop = {});

}  // namespace lyrefit
