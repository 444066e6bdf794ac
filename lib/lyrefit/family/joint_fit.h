#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// The joint fit of some curves from several starts: every start is refined on the curves of the
// search, the best two on all. With priors the noise that they are weighed against is found on the
// way. `problem` (on `curves`) gets that noise, and
// holds what is a whole number where the best fit has it. Stopped by the observer, it is the best
// so far.
JointEnd FitJointly(const FamilyProblem& family, const FamilyOptions& options,
                    const std::vector<int>& search_curves, const std::vector<JointPoint>& starts,
                    const Observer& observer, JointProblem* problem);

// Finds the noise that priors are weighed against at the end of a fit, and refines from there, until
// both agree. Nothing without priors.
void SettleNoise(const FamilyProblem& family, const JointOptions& how, JointProblem* problem,
                 JointEnd* end);

// What becomes of the search's best candidate by itself: after one bounded solve of all curves, and
// after a joint fit that begins at it alone.
struct CandidateEnds {
  JointEnd plain;
  JointEnd own;
  double plain_seconds = 0;
  double own_seconds = 0;
};
CandidateEnds PolishCandidate(const FamilyProblem& family, const FamilyOptions& options,
                    const std::vector<int>& search_curves, const JointPoint& candidate,
                    const Observer& observer, JointProblem problem);

// A start from a curve's own fit: its parameters brought to the reference by the usual
// coefficients. Empty where they do not go there.
std::vector<double> StartFromIndividualFit(const FamilyProblem& family, const JointCurve& curve,
                                     const std::vector<double>& free_parameters);

}  // namespace lyrefit
