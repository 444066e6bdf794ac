#pragma once

#include <vector>

#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/spread.h"
#include "synthetic/curves.h"

namespace lyrefit {

// A 36-cell module at `points` voltages from 0 to slightly beyond Voc, with noise of `noise_A`.
inline RefineProblem ModuleProblem(Model truth, Model fitted, const std::vector<double>& p,
                                   double noise_A, Objective objective, std::uint64_t seed = 1,
                                   int points = 40) {
  const IvCurve curve = ModuleCurve(truth, p, noise_A, seed, points, 21.6);
  const Device device = MakeDevice(fitted, curve.conditions);
  std::vector<double> lower = {0, 0, 1, 0, 0.5};
  std::vector<double> upper = {8, 1e-4, 2, 5, 1e13};
  for (int d = 1; d < DiodeCount(device); ++d) {
    lower.insert(lower.end(), {0, 1});
    upper.insert(upper.end(), {1e-4, 2});
  }
  return MakeRefineProblem(device, objective, curve.voltage_V, curve.current_A, {}, lower, upper);
}

// Variance of a residual of weight 1.
inline double VarianceOf(const RefineProblem& problem, const RefineEnd& end, int degrees) {
  return end.mean_square * static_cast<double>(problem.voltage_V.size()) / degrees;
}

inline Spread SpreadOf(const RefineProblem& problem, const RefineEnd& end, int degrees) {
  return FindSpread(CurveModel(problem), end, end.active, VarianceOf(problem, end, degrees));
}

inline const std::vector<double> kTwoDiodeTruth = {3.8, 2e-9, 1.07, 0.25, 300, 4e-6, 1.9};

}  // namespace lyrefit
