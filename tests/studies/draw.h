#pragma once

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/model/model_points.h"  // SaturationCurrent

namespace lyrefit {

// Uniform in [low, high).
inline double Between(double low, double high, RandomStream* random) {
  return low + (high - low) * random->Uniform();
}

// Log-uniform in [low, high).
inline double LogBetween(double low, double high, RandomStream* random) {
  return low * std::pow(high / low, random->Uniform());
}

// Uniform in {low, ..., high}.
inline int WholeBetween(int low, int high, RandomStream* random) {
  return low + static_cast<int>(random->Index(static_cast<std::uint32_t>(high - low + 1)));
}

}  // namespace lyrefit
