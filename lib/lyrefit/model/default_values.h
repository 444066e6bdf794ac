#pragma once

#include "lyrefit/model/translation.h"

namespace lyrefit {

// Default values of parameters that a joint fit keeps fixed.
constexpr double kDefaultBandgap_eV = 1.121;  // crystalline silicon at 25 C (De Soto 2006)
constexpr double kDefaultBandgapSlope_per_K = kDeSotoBandgapSlope_per_K;
constexpr double kDefaultShuntExponent = 5.5;  // PVsyst's default
constexpr double kDefaultIdeality2 = 2;        // recombination in the depletion region
constexpr double kDefaultBuiltIn_V = 0.9;      // V per cell, PVsyst's default for thin films
constexpr double kDefaultTempco_per_K = 5e-4;  // relative alpha_sc of silicon

}  // namespace lyrefit
