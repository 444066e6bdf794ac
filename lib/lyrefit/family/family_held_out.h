#pragma once

#include <vector>

#include "lyrefit/family/family_problem.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// Tests shared parameters (with both sensor errors) on whole curves at their stated conditions.
// Curves whose conditions nobody stated cannot be tested.
HeldOut TestOn(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
               const std::vector<double>& shared, const std::vector<int>& curves);

// Leaves whole curves out in turn, fits the others anew from the joint optimum and tests on those
// left out.
HeldOut TestByFolds(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
                    const JointProblem& problem, const JointEnd& end);

}  // namespace lyrefit
