#pragma once

#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/law/kernel.h"

namespace lyrefit {

inline const std::vector<double> kSingleTruth = {3.8, 2e-8, 1.2, 0.25, 300};
inline const std::vector<double> kDoubleTruth = {3.8, 5e-10, 1.02, 0.2, 300, 2e-5, 2};

// A 36-cell module at 25 C, `points` readings from 0 V to a little past Voc, Gaussian noise.
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

}  // namespace lyrefit
