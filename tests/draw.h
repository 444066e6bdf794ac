#pragma once

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {

inline double Between(RandomStream* random, double low, double high) {
  return low + (high - low) * random->Uniform();
}

inline double LogUniform(RandomStream* random, double low, double high) {
  return low * std::pow(high / low, random->Uniform());
}

}  // namespace lyrefit
