#include "faults/field_departure.h"

#include <algorithm>
#include <cmath>

namespace faults::field {
namespace {

constexpr double kFarthest = 1.1;
constexpr int kSteps = 440;

// Sum of smoothed steps of either sign, each with its own length. It is rough on small scales but
// not Gaussian, unlike the path that an error model assumes.
std::vector<double> RoughPath(Random* random) {
  std::vector<double> path(kSteps + 1, 0.0);
  const int count = 40 + random->Index(120);
  for (int k = 0; k < count; ++k) {
    const double at = random->Uniform(-0.1, kFarthest + 0.1);
    const double length = random->LogUniform(0.004, 0.2);
    const double size = random->Sign() * std::sqrt(-std::log(random->Unit()) / count);
    for (int i = 0; i <= kSteps; ++i) {
      path[i] += size * std::tanh((kFarthest * i / kSteps - at) / length);
    }
  }
  return path;
}

}  // namespace

double Departure::At(double u, double lost) const {
  if (size == 0) return 0;
  const double place = std::clamp(u / kFarthest, 0.0, 1.0) * kSteps;
  const int i = std::min(static_cast<int>(place), kSteps - 1);
  double sum = path[i] + (place - i) * (path[i + 1] - path[i]);
  for (const Bump& bump : bumps) {
    const double far = (u - bump.at) / bump.width;
    sum += bump.size / (1 + far * far * far * far);
  }
  sum *= flat + (1 - flat) / (1 + std::exp((0.65 - u) / 0.05));
  const double part = std::clamp(lost, 0.0, 1.0);
  sum += knee * std::pow(part, knee_exponent) * (1 - part);
  return size * sum;
}

Departure DrawDeparture(Random* random) {
  Departure departure;
  departure.size = 1;
  const double rough = random->Uniform(0.2, 1);
  departure.path = RoughPath(random);
  for (double& value : departure.path) value *= rough;
  const int bumps = 2 + random->Index(7);
  for (int k = 0; k < bumps; ++k) {
    departure.bumps.push_back({random->Uniform(0, 1.05), random->LogUniform(0.03, 0.4),
                               random->Normal() * random->Uniform(0.2, 1)});
  }
  departure.flat = random->LogUniform(0.12, 1);
  departure.knee = 4 * random->Normal();
  departure.knee_exponent = random->Uniform(0.4, 1.6);
  return departure;
}

}  // namespace faults::field
