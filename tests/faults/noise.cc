#include "faults/noise.h"

#include <cmath>

namespace faults {
namespace {

constexpr const char* kNames[kNoiseTypes] = {"equal", "proportional", "mixed", "quantised",
                                             "correlated"};

double RangeOf(const Setting& at) { return at.suns == 0 ? 0.1 : 1; }

}  // namespace

const char* Name(NoiseType type) { return kNames[static_cast<int>(type)]; }

Noise DrawNoise(NoiseType type, double photocurrent, Random* random) {
  Noise noise;
  noise.type = type;
  const double size = random->LogUniform(3e-4, 3e-3);
  noise.constant_A = size * photocurrent;
  if (type == NoiseType::kProportional) {
    noise.relative = size;
    noise.constant_A *= 0.05;
  } else if (type == NoiseType::kMixed) {
    noise.relative = size * random->LogUniform(0.3, 3);
  } else if (type == NoiseType::kQuantised) {
    noise.resolution_A = noise.constant_A * random->Uniform(0.3, 2);
  } else if (type == NoiseType::kCorrelated) {
    noise.neighbours = 0.3;
  }
  return noise;
}

std::vector<double> Sigmas(const Noise& noise, const Plan& plan, const std::vector<double>& exact) {
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double range = RangeOf(plan.settings[i]);
    const double constant = range * noise.constant_A;
    const double relative = noise.relative * exact[i];
    const double step = range * noise.resolution_A;
    sigmas.push_back(std::sqrt(constant * constant + relative * relative + step * step / 12));
  }
  return sigmas;
}

std::vector<double> Rounded(double resolution_A, const Plan& plan, std::vector<double> currents) {
  if (resolution_A <= 0) return currents;
  for (std::size_t i = 0; i < currents.size(); ++i) {
    const double step = RangeOf(plan.settings[i]) * resolution_A;
    currents[i] = std::round(currents[i] / step) * step;
  }
  return currents;
}

std::vector<double> WithNoise(const Noise& noise, const Plan& plan,
                              const std::vector<double>& exact, Random* random) {
  Noise smooth = noise;
  smooth.resolution_A = 0;
  const std::vector<double> sigmas = Sigmas(smooth, plan, exact);
  std::vector<double> shown;
  double before = random->Normal();
  const double rest = std::sqrt(1 - noise.neighbours * noise.neighbours);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    before = noise.neighbours * before + rest * random->Normal();
    shown.push_back(exact[i] + sigmas[i] * before);
  }
  return Rounded(noise.resolution_A, plan, shown);
}

}  // namespace faults
