#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_effects.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Fills estimates, sensor errors, coefficients, correlations, key points at the reference, offsets
// of the curves and the noise of `report` from the end of a joint fit on the curves `fitted`.
// All of it is in the units of reports (Quote) but the report's `refined`, which it fills as well.
// Stopped by the observer, it leaves out the profiles and marks the report as interrupted.
void JudgeFamily(const QuotedFit& fit, const FamilyOptions& options, const Observer& observer,
                 FamilyReport* report);

// Delete-one-curve jackknife: every shared parameter when whole curves are taken as independent.
// Stopped by the observer, it marks the report as interrupted and fills nothing.
void Jackknife(const FamilyProblem& family, const JointProblem& problem, const JointEnd& end,
               int threads, const Observer& observer, FamilyReport* report);

// Points less the unknowns they decide, at least 1.
double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees);

}  // namespace lyrefit
