#pragma once

#include <optional>
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

// The weights used, and the gain in likelihood that selected them.
struct WeightChoice {
  FamilyWeights used = FamilyWeights::kEqual;
  // Twice the gain in ln likelihood of errors proportional to each curve's Isc over errors of equal
  // size. None: no selection was made. NaN: the residuals exceed noise; their sizes then show the
  // misfit of the law, not errors of readings, and equal weights stay.
  std::optional<double> gain;
};

// Determines the weights for FamilyWeights::kAuto at the end of a joint fit with equal weights. The
// residuals are noise if they are about as large as differences of neighbouring residuals. The
// curves are then refitted with weights relative to Isc, and the weights with the larger likelihood
// of the residuals are selected. Each likelihood is taken at its own optimum and noise level:
//   ln L = -N / 2 ln(sum of w r^2 / N) + 1/2 sum of ln w
// `family`, `problem` and `end` receive the selected fit. No selection is made if the options set
// the weights, if every reading states its own standard deviation, or if the residuals are only
// rounding.
WeightChoice SettleWeights(const FamilyOptions& options, const Observer& observer,
                           FamilyProblem* family, JointProblem* problem, JointEnd* end);

}  // namespace lyrefit
