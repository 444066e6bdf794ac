#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Error: parameters to test (`options.against`) whose number of cells differs from that of the set.
Expected<void> CheckAgainst(const FamilyProblem& family, const FamilyOptions& options);

// Tests the joint fit on whole curves at their stated conditions: on the held-out curves, or by
// cross-validation over folds. Tests the parameters of `options.against` on the same curves. Fills
// held_out, against and in_sample. Curves without stated conditions are not tested. The report must
// already contain the individual fits. If the observer stops it, it marks the report as interrupted
// and fills nothing.
void TestFamily(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
                const JointProblem& problem, const JointEnd& end, const Observer& observer,
                FamilyReport* report);

}  // namespace lyrefit
