#pragma once

#include <vector>

#include "lyrefit/family/family_judge.h"

namespace lyrefit {

// Finds the errors of the readings and the intervals under correlated errors. The joint fit is a
// least-squares fit, but points of one curve share the path error of the irradiance during the
// sweep and the errors of the curve's stated irradiance and temperature. The kind of errors, and
// the power of the irradiance with which the path error grows, are selected by likelihood. The
// likelihood is that of curves that were not fitted (`rest`, at the joint parameters) if there are
// at least three. Otherwise each half of the curves is tested with the error sizes of the other
// half; fewer than six curves are tested with their own sizes. A richer kind must be clearly
// better.
//
// `judged` has the results of JudgeFamily.
FamilyErrorIntervals FindFamilyIntervals(const ReportedFit& fit, const JointProblem& rest,
                                         const JudgedEnd& judged);

}  // namespace lyrefit
