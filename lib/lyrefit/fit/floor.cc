#include "lyrefit/fit/floor.h"

#include <algorithm>

#include "lyrefit/law/device.h"

namespace lyrefit {

CertifyOptions RangesOf(const std::vector<ParameterBounds>& bounds, ConstantSet constants,
                        std::vector<Model> models) {
  CertifyOptions options;
  options.constants = constants;
  options.models = std::move(models);
  options.rs_lower_ohm = bounds[kRs].lower;
  options.rs_upper_ohm = bounds[kRs].upper;
  options.n_lower = bounds[IdealityIndex(0)].lower;
  options.n_upper = bounds[IdealityIndex(0)].upper;
  for (int d = 1; IdealityIndex(d) < static_cast<int>(bounds.size()); ++d) {
    options.n_lower = std::min(options.n_lower, bounds[IdealityIndex(d)].lower);
    options.n_upper = std::max(options.n_upper, bounds[IdealityIndex(d)].upper);
  }
  // A single value of n is a narrow range.
  if (!(options.n_lower < options.n_upper)) options.n_upper = options.n_lower * (1 + 1e-9);
  return options;
}

}  // namespace lyrefit
