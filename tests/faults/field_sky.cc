#include "faults/field_sky.h"

#include <algorithm>
#include <cmath>

namespace faults::field {
namespace {

constexpr int kSteps = 600;
constexpr double kTurn = 6.283185307179586;

void Forget(Random* random, std::vector<double>* path) {
  const double keep = std::exp(-1.0 / (kSteps * random->LogUniform(0.05, 2)));
  double now = random->Normal();
  for (double& value : *path) {
    value = now;
    now = keep * now + std::sqrt(1 - keep * keep) * random->Normal();
  }
}

void Wander(Random* random, std::vector<double>* path) {
  double now = 0;
  for (double& value : *path) value = now += random->Normal();
}

void Swing(Random* random, std::vector<double>* path) {
  for (int wave = 0; wave < 4; ++wave) {
    const double turns = random->LogUniform(0.3, 12), phase = random->Unit();
    const double size = random->Normal() / std::sqrt(turns);
    for (int i = 0; i <= kSteps; ++i) {
      (*path)[i] += size * std::sin(kTurn * (phase + turns * i / kSteps));
    }
  }
}

}  // namespace

std::vector<double> DrawWander(double size, Random* random) {
  std::vector<double> path(kSteps + 1, 0.0);
  void (*const kinds[])(Random*, std::vector<double>*) = {Forget, Wander, Swing};
  kinds[random->Index(3)](random, &path);
  double mean = 0, square = 0;
  for (const double value : path) mean += value / path.size();
  for (const double value : path) square += (value - mean) * (value - mean) / path.size();
  for (double& value : path) value = (value - mean) * size / std::sqrt(square);
  return path;
}

double Sky::Light(double time) const {
  if (cloud == Cloud::kStep) return time > at ? 1 + size : 1;
  if (cloud == Cloud::kDrift) {
    return 1 + size * (time - 0.5 + skew * (time - 0.5) * (time - 0.5));
  }
  if (cloud == Cloud::kNone) return 1;
  if (cloud == Cloud::kEdge) {
    const double part = std::clamp((time - at) / width + 0.5, 0.0, 1.0);
    return 1 + size * std::pow(std::sin(kTurn / 4 * part), 2);
  }
  const double side = width * (time < at ? 1 - skew : 1 + skew);
  const double far = std::fabs(time - at) / side;
  return far < 1 ? 1 - size * std::pow(std::cos(kTurn / 4 * far), 2) : 1;
}

double Sky::WanderingLight(double time) const {
  if (wander.empty()) return Light(time);
  const double place = std::clamp(time, 0.0, 1.0) * kSteps;
  const int i = std::min(static_cast<int>(place), kSteps - 1);
  return Light(time) * (1 + wander[i] + (place - i) * (wander[i + 1] - wander[i]));
}

}  // namespace faults::field
