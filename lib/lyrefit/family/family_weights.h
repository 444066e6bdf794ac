#pragma once

#include <optional>

#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {

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
