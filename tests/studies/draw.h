#pragma once

#include <cmath>

#include "lyrefit/base/random.h"

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

// Saturation current in ampere of a diode that carries `current_A` at `voltage_V`.
inline double SaturationCurrent(double current_A, double voltage_V, double nNsVth) {
  return current_A / std::expm1(voltage_V / nNsVth);
}

}  // namespace lyrefit
