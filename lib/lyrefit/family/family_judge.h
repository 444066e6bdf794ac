#pragma once

#include "lyrefit/family/family_problem.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Fills estimates, sensor errors, coefficients, correlations, key points at the reference, offsets
// of the curves and the noise of `report` from the end of a joint fit on the curves `fitted`.
void JudgeFamily(const FamilyProblem& family, const FamilyOptions& options,
                 const JointProblem& problem, const JointEnd& end, FamilyReport* report);

// Delete-one-curve jackknife: every shared parameter when whole curves are taken as independent.
void Jackknife(const FamilyProblem& family, const JointProblem& problem, const JointEnd& end,
               int threads, FamilyReport* report);

// Points less the unknowns they decide, at least 1.
double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees);

}  // namespace lyrefit
