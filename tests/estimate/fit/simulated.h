#pragma once

#include <cmath>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

inline const std::vector<double> kSingleTruth = {3.8, 2e-8, 1.2, 0.25, 300};
inline const std::vector<double> kDoubleTruth = {3.8, 5e-10, 1.02, 0.2, 300, 2e-5, 2};

// A 36-cell module at 25 C with `points` readings from 0 V to slightly beyond Voc and Gaussian
// noise of the current, in ampere.
inline IvCurve ModuleCurve(Model model, const std::vector<double>& p, double noise_A,
                           std::uint64_t seed = 1, int points = 60) {
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = 36;
  for (int k = 0; k < points; ++k) curve.voltage_V.push_back(21.8 * k / (points - 1));
  curve.current_A = SolveCurrents(MakeDevice(model, curve.conditions), p.data(), curve.voltage_V);
  RandomStream random(seed);
  for (double& i : curve.current_A) i += noise_A * random.Normal();
  return curve;
}

// A single diode whose irradiance wanders by 1e-3 during the sweep (autoregressive, with the length
// of the sweep). The voltages have relative noise of 3e-4.
inline IvCurve WanderingCurve(int seed, int points = 100) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 0, 1, points);
  RandomStream random(seed, 0);
  double light = random.Normal();
  const double kept = std::exp(-1.0 / points);
  for (int k = 0; k < points; ++k) {
    light = kept * light + std::sqrt(1 - kept * kept) * random.Normal();
    curve.current_A[k] *= 1 + 1e-3 * light;
    curve.voltage_V[k] *= 1 + 3e-4 * random.Normal();
  }
  return curve;
}

}  // namespace lyrefit
