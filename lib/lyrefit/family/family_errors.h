#pragma once

#include <vector>

#include "lyrefit/family/family_effects.h"

namespace lyrefit {

// Fills the report's errors and its intervals under them: the joint fit is that of least squares,
// but points of one curve share the light's path and the errors of the curve's stated light and
// temperature. How much of that there is, the likelihood of curves that were not fitted decides,
// where there are some (`rest`, all of them at the joint parameters); else the restricted one.
void FindFamilyIntervals(const QuotedFit& fit, const JointProblem& rest, FamilyReport* report);

}  // namespace lyrefit
