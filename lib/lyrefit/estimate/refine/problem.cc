#include "lyrefit/estimate/refine/problem.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/solve.h"

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

namespace {

// Derivatives of a term's two prepared numbers by its at most three parameters.
using OfThree = Dual<3>;

PreparedTerm<OfThree> DifferentiateTerm(const Device& device, const Term& term, const double* p) {
  OfThree own[3];
  Term in_own{term.kind, {-1, -1, -1}};
  for (int k = 0; k < 3; ++k) {
    if (term.parameter[k] < 0) continue;
    own[k] = OfThree(p[term.parameter[k]], k);
    in_own.parameter[k] = k;
  }
  PreparedTerm<OfThree> prepared;
  PrepareTerm(in_own, own, device.module_thermal_voltage_V, &prepared);
  return prepared;
}

}  // namespace

Block* ScratchBlocks(std::size_t size) {
  thread_local std::vector<Block> blocks;
  if (blocks.size() < size) blocks.resize(size);
  return blocks.data();
}

void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const PointSet& points, const Kernel& kernel, double* current, double* slopes,
                   const std::vector<char>* fixed, LawWorkspace* kept) {
  const bool measured = objective == Objective::kMeasuredCurrent;
  if (device.effects != nullptr) {
    if (measured || !ExtendedCurrents(device, p, current, slopes, fixed, kept)) {
      current[0] = kUnknown;
    }
    return;
  }
  const int size = points.size, count = device.size();
  const PreparedDevice prepared = Prepare(device, p);
  const std::size_t length = points.voltage_V.size();
  Block* const solved = ScratchBlocks((3 + 2 * prepared.count) * length);
  Block* const rows = solved + length;
  if (!measured) {
    kernel.solve_currents(prepared, points,
                          JunctionVoltageLimit(prepared, points.largest_voltage_V), solved);
    std::memcpy(current, solved, size * sizeof(double));
    if (slopes == nullptr) return;
  }
  const Block* const at = measured ? points.current_A.data() : solved;
  kernel.explicit_currents(prepared.terms, prepared.count, prepared.rs, points, at, rows);
  if (measured) std::memcpy(current, rows, size * sizeof(double));
  if (slopes == nullptr) return;
  const double* const currents = NumbersOf(at);
  const double* const conductance = NumbersOf(rows + length);
  std::fill(slopes, slopes + static_cast<std::ptrdiff_t>(size) * count, 0.0);
  for (int t = 0; t < prepared.count; ++t) {
    const Term& term = device.terms[t];
    const PreparedTerm<OfThree> number = DifferentiateTerm(device, term, p);
    const double* const by_a = NumbersOf(rows + (2 + 2 * t) * length);
    const double* const by_b = NumbersOf(rows + (3 + 2 * t) * length);
    for (int i = 0; i < 3 && term.parameter[i] >= 0; ++i) {
      double* to = slopes + term.parameter[i];
      for (int k = 0; k < size; ++k, to += count) {
        *to += by_a[k] * number.a.v[i] + by_b[k] * number.b.v[i];
      }
    }
  }
  for (int k = 0; k < size; ++k) {
    double* const row = slopes + static_cast<std::ptrdiff_t>(k) * count;
    row[device.resistance_series] += conductance[k] * currents[k];
    if (measured) continue;
    const double factor = 1 / (1 - prepared.rs * conductance[k]);
    for (int i = 0; i < count; ++i) row[i] *= factor;
  }
}

}  // namespace lyrefit
