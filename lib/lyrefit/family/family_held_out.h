#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Errors: parameters from elsewhere that are of another number of cells than the set.
Expected<void> CheckAgainst(const FamilyProblem& family, const FamilyOptions& options);

// Tests the joint fit on whole curves at their stated conditions, those held out or else by folds,
// and parameters from elsewhere on the same curves: fills held_out, against and in_sample. Curves
// whose conditions nobody stated cannot be tested; the fits of single curves are in the report
// already. Stopped by the observer, it marks the report as interrupted and fills nothing.
void TestFamily(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
                const JointProblem& problem, const JointEnd& end, const Observer& observer,
                FamilyReport* report);

}  // namespace lyrefit
