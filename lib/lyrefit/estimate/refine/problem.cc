#include "lyrefit/estimate/refine/problem.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lyrefit/base/largest.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/estimate/refine/model_current.h"

namespace lyrefit {
namespace {

// Largest magnitude of the values; 1 if all are 0.
double ScaleOf(const std::vector<double>& values) {
  const double largest = LargestMagnitude(values);
  return largest > 0 ? largest : 1;
}

}  // namespace

RefineProblem MakeRefineProblem(Device device, Objective objective, std::vector<double> voltage_V,
                                std::vector<double> current_A, std::vector<double> weights,
                                std::vector<double> lower, std::vector<double> upper) {
  CHECK_EQ(static_cast<int>(lower.size()), device.size());
  CHECK_EQ(lower.size(), upper.size());
  RefineProblem problem;
  problem.device = std::move(device);
  problem.objective = objective;
  problem.voltage_V = std::move(voltage_V);
  problem.current_A = std::move(current_A);
  problem.lower = std::move(lower);
  problem.upper = std::move(upper);
  problem.kernel = &FastestKernel();
  if (weights.empty()) weights.assign(problem.voltage_V.size(), 1.0);
  const double mean =
      std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(weights.size());
  for (double& weight : weights) weight /= mean;
  problem.weights = std::move(weights);
  problem.points = MakePointSet(problem.voltage_V, problem.current_A, problem.weights);
  problem.current_scale_A = ScaleOf(problem.current_A);
  const double forward_V = problem.points.largest_voltage_V;
  problem.voltage_scale_V = forward_V > 0 ? forward_V : ScaleOf(problem.voltage_V);
  return problem;
}

void Residuals(const RefineProblem& problem, const double* p, double* residuals, double* slopes,
               LawWorkspace* kept) {
  const int points = static_cast<int>(problem.voltage_V.size()), count = problem.device.size();
  std::vector<char> fixed;
  const bool skips = slopes != nullptr && problem.device.effects != nullptr;
  for (int i = 0; skips && i < count; ++i) fixed.push_back(problem.fixed(i) ? 1 : 0);
  ModelCurrents(problem.device, problem.objective, p, problem.points, *problem.kernel, residuals,
                slopes, &fixed, kept);
  for (int k = 0; k < points; ++k) {
    const double root = std::sqrt(problem.weights[k]);
    residuals[k] = (residuals[k] - problem.current_A[k]) * root;
    for (int i = 0; slopes != nullptr && i < count; ++i) slopes[k * count + i] *= root;
  }
  if (problem.errors == nullptr) return;
  Whiten(*problem.errors, {}, Eigen::Map<RowMatrix>(residuals, points, 1));
  if (slopes != nullptr) Whiten(*problem.errors, {}, Eigen::Map<RowMatrix>(slopes, points, count));
}

double MeanSquare(const RefineProblem& problem, const std::vector<double>& p, LawWorkspace* kept) {
  if (problem.errors != nullptr || kept != nullptr) {
    Eigen::VectorXd residuals(problem.voltage_V.size());
    Residuals(problem, p.data(), residuals.data(), nullptr, kept);
    return residuals.squaredNorm() / static_cast<double>(residuals.size());
  }
  return MeanSquare(problem.device, problem.objective, p.data(), problem.points, *problem.kernel);
}

}  // namespace lyrefit
