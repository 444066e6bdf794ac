#pragma once

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/refine/model.h"

namespace lyrefit {

constexpr double kDecayNoise = 1e-3;
constexpr int kDecayPoints = 30;

// A model without photovoltaics: y = height exp(-rate x) + offset in two blocks, each with its own
// offset.
class Decay : public FitModel {
 public:
  explicit Decay(std::uint64_t seed, double least_rate = 0) : FitModel(MakeShape(least_rate)) {
    RandomStream random(seed);
    for (int b = 0; b < 2; ++b) {
      for (int k = 0; k < kDecayPoints; ++k) {
        measured_[b][k] = 2 * std::exp(-0.7 * X(k)) + 0.1 * b + kDecayNoise * random.Normal();
      }
    }
  }

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override {
    for (int k = 0; k < kDecayPoints; ++k) {
      const double part = std::exp(-p[1] * X(k));
      residuals[k] = p[0] * part + local[0] - measured_[block][k];
      if (slopes != nullptr) slopes[2 * k] = part;
      if (slopes != nullptr) slopes[2 * k + 1] = -X(k) * p[0] * part;
      if (local_slopes != nullptr) local_slopes[k] = 1;
    }
    return true;
  }

 private:
  static double X(int k) { return 0.1 * k; }
  static ModelShape MakeShape(double least_rate) {
    ModelShape shape;
    shape.parameters = {{ParameterKind::kPhotocurrent, 1, {-1, -1}, 0, 10},
                        {ParameterKind::kPlain, 1, {-1, -1}, least_rate, 5}};
    shape.blocks = {{kDecayPoints, 1}, {kDecayPoints, 1}};
    shape.points = 2 * kDecayPoints;
    return shape;
  }
  double measured_[2][kDecayPoints];
};

}  // namespace lyrefit
