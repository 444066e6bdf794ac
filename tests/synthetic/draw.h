#pragma once

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {

// Uniform in [low, high).
inline double Between(RandomStream* random, double low, double high) {
  return low + (high - low) * random->Uniform();
}

// Log-uniform in [low, high).
inline double LogUniform(RandomStream* random, double low, double high) {
  return low * std::pow(high / low, random->Uniform());
}

// Uniform in {low, ..., high}.
inline int WholeBetween(RandomStream* random, int low, int high) {
  return low + static_cast<int>(random->Index(static_cast<std::uint32_t>(high - low + 1)));
}

}  // namespace lyrefit
