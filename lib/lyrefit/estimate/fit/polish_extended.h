#pragma once

#include <vector>

#include "lyrefit/estimate/fit/descents.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/search_space.h"

namespace lyrefit {

struct ExtendedPolish : PolishResult {
  std::vector<VariantReport> variants;
  int variant = 0;  // of the best end
};

// Polish of a device with effects, which has many local optima, in three stages. (1) Starts are the
// best candidate and the shape of the curve, and probes for effects without a shape. (2) If the
// best optimum was reached only once, further elites follow. Random points follow if that is still
// so or its residuals are not noise. (3) Neighbours of the best end: other integers, other
// settings, single parameters moved.
ExtendedPolish PolishExtended(const PreparedFit& fit, const std::vector<PolishStart>& candidates,
                              const SearchSpace& space, const ProgressReporter& progress);

}  // namespace lyrefit
