#pragma once

#include <vector>

#include "lyrefit/family/family_effects.h"

namespace lyrefit {

// Fills the report's errors and its intervals under them: the joint fit is that of least squares,
// but points of one curve share the light's path and the errors of the curve's stated light and
// temperature. Which of that there is, and with which power of the light the path grows, is decided
// by the likelihood of curves that were not fitted, where there are some (`rest`, at the joint
// parameters); else of each half of the curves under the sizes of the other half; of fewer than six
// by their own. A richer kind must be clearly better.
void FindFamilyIntervals(const QuotedFit& fit, const JointProblem& rest, FamilyReport* report);

}  // namespace lyrefit
