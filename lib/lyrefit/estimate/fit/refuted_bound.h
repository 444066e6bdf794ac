#pragma once

#include <string>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/refine_fit.h"

namespace lyrefit {

// Bounds that the readings refute.
struct RefutedBounds {
  std::string because;      // the reason as a sentence; empty: none is refuted
  std::string test;         // its first part: which bounds, and how much better more room is
  BoundsSpec::Table wider;  // ranges of more room; key: symbol
};

// Tests whether the readings refute a bound at which an ideality factor is active, or any parameter
// of the diodes at a bound that is not lyrefit's own. The problem is fitted again with a wider range, and the F-test decides at 5 % whether that describes the
// readings better. If their errors are correlated, the likelihood under those errors must agree.
// Every interval of a refuted fit would be conditional on a false assumption.
RefutedBounds FindRefutedBounds(const RefinedFit& refined, const ProgressReporter& progress);

}  // namespace lyrefit
