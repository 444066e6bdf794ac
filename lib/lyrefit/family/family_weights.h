#pragma once

#include <optional>

#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// How the curves were weighed, and what the residuals said for it.
struct WeightChoice {
  FamilyWeights used = FamilyWeights::kEqual;
  // Twice what ln likelihood gains by errors in proportion to each curve's Isc over errors of one
  // size; none: nothing was to be chosen. NaN: the residuals are more than noise, so that their sizes
  // say what the law misses and nothing of the readings; equal weights stay.
  std::optional<double> gain;
};

// Settles FamilyWeights::kAuto at the end of a joint fit with equal weights. Where the residuals
// are no larger than what neighbouring ones differ by, they are noise; the curves are then fitted
// once more from there with weights relative to Isc, and the weights stay under which the
// likelihood of the residuals is larger, each at its own optimum and with its own size of the noise:
//   ln L = -N / 2 ln(sum of w r^2 / N) + 1/2 sum of ln w
// `family`, `problem` and `end` get what was chosen. Nothing is chosen where the options say which
// weights, where every reading states its own standard deviation, or where only rounding is left.
WeightChoice SettleWeights(const FamilyOptions& options, const Observer& observer,
                           FamilyProblem* family, JointProblem* problem, JointEnd* end);

}  // namespace lyrefit
