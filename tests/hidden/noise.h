#pragma once

#include <cstdint>
#include <vector>

#include "hidden/plan.h"

namespace hidden {

enum class NoiseType { kEqual, kProportional, kMixed, kQuantised, kCorrelated };
constexpr int kNoiseTypes = 5;
const char* Name(NoiseType type);

struct Noise {
  NoiseType type = NoiseType::kEqual;
  double constant_A = 1e-3;  // standard deviation; a tenth in the dark
  double relative = 0;
  double resolution_A = 0;  // rounding step; a tenth in the dark
  double neighbours = 0;    // correlation from reading to reading
};

Noise DrawNoise(NoiseType type, double photocurrent, Random* random);

// Standard deviations about the exact currents, rounding included.
std::vector<double> Sigmas(const Noise& noise, const Plan& plan, const std::vector<double>& exact);

std::vector<double> WithNoise(const Noise& noise, const Plan& plan,
                              const std::vector<double>& exact, Random* random);

// In the dark a finer range is used.
std::vector<double> Rounded(double resolution_A, const Plan& plan, std::vector<double> currents);

}  // namespace hidden
