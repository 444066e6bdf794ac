#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/spread.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// A 36-cell module at `points` voltages from 0 to slightly beyond Voc, with noise of `noise_A`.
inline RefineProblem ModuleProblem(Model truth, Model fitted, const std::vector<double>& p,
                                   double noise_A, Objective objective, std::uint64_t seed = 1,
                                   int points = 40) {
  Conditions conditions;
  conditions.cells_in_series = 36;
  std::vector<double> voltage;
  for (int k = 0; k < points; ++k) voltage.push_back(21.6 * k / (points - 1));
  std::vector<double> current = SolveCurrents(MakeDevice(truth, conditions), p.data(), voltage);
  RandomStream random(seed);
  for (double& i : current) i += noise_A * random.Normal();
  const Device device = MakeDevice(fitted, conditions);
  std::vector<double> lower = {0, 0, 1, 0, 0.5};
  std::vector<double> upper = {8, 1e-4, 2, 5, 1e13};
  for (int d = 1; d < DiodeCount(device); ++d) {
    lower.insert(lower.end(), {0, 1});
    upper.insert(upper.end(), {1e-4, 2});
  }
  return MakeRefineProblem(device, objective, voltage, current, {}, lower, upper);
}

// Variance of a residual of weight 1.
inline double VarianceOf(const RefineProblem& problem, const RefineEnd& end, int degrees) {
  return end.mean_square * static_cast<double>(problem.voltage_V.size()) / degrees;
}

inline Spread SpreadOf(const RefineProblem& problem, const RefineEnd& end, int degrees) {
  return FindSpread(CurveModel(problem), end, end.active, VarianceOf(problem, end, degrees));
}

inline const std::vector<double> kSingleTruth = {3.8, 2e-8, 1.2, 0.25, 300};
inline const std::vector<double> kDoubleTruth = {3.8, 2e-9, 1.07, 0.25, 300, 4e-6, 1.9};

}  // namespace lyrefit
