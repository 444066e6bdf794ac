#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {

// Fits the given curves jointly from several starts. Every start is refined on the search curves,
// the best two then on all curves. If there are priors, the noise that scales them is estimated as
// well. `problem` (on all fitted curves) receives that noise, and its integer-valued parameters are
// fixed at the values of the best fit. If the observer stops the fit, the result is the best so
// far.
JointEnd FitJointly(const FamilyProblem& family, const FamilyOptions& options,
                    const std::vector<int>& search_curves, const std::vector<JointPoint>& starts,
                    const Observer& observer, JointProblem* problem);

// Estimates the noise that scales priors at the end of a fit and refines again, until both agree.
// Does nothing without priors.
void SettleNoise(const FamilyProblem& family, const JointOptions& how, JointProblem* problem,
                 JointEnd* end);

// The search's best candidate after one bounded solve on all curves, and after a joint fit that
// starts from it alone.
struct CandidateEnds {
  JointEnd plain;
  JointEnd own;
  double plain_seconds = 0;
  double own_seconds = 0;
};
CandidateEnds PolishCandidate(const FamilyProblem& family, const FamilyOptions& options,
                              const std::vector<int>& search_curves, const JointPoint& candidate,
                              const Observer& observer, JointProblem problem);

// Builds a start from a curve's individual fit: its parameters translated to the reference with
// usual coefficients. Empty if no saturation current at the reference gives that of the curve.
std::vector<double> StartFromIndividualFit(const FamilyProblem& family, const JointCurve& curve,
                                           const std::vector<double>& individual_parameters);

}  // namespace lyrefit
