#pragma once

#include <cstdint>
#include <vector>

#include "faults/plan.h"

namespace faults {

enum class NoiseType { kEqual, kProportional, kMixed, kQuantised, kCorrelated };
constexpr int kNoiseTypes = 5;
const char* Name(NoiseType type);

struct Noise {
  NoiseType type = NoiseType::kEqual;
  double constant_A = 1e-3;  // standard deviation; a tenth of it in the dark
  double relative = 0;
  double resolution_A = 0;  // rounding step; a tenth of it in the dark
  double neighbours = 0;    // correlation of neighbouring readings
};

Noise DrawNoise(NoiseType type, double photocurrent, Random* random);

// Standard deviations of the readings about the exact currents, rounding included, in A.
std::vector<double> Sigmas(const Noise& noise, const Plan& plan, const std::vector<double>& exact);

std::vector<double> WithNoise(const Noise& noise, const Plan& plan,
                              const std::vector<double>& exact, Random* random);

// Rounds to multiples of `resolution_A`, or of a tenth of it in the dark, where a finer range
// applies.
std::vector<double> Rounded(double resolution_A, const Plan& plan, std::vector<double> currents);

}  // namespace faults
