#include "lyrefit/estimate/fit/robust.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/model_current.h"

namespace lyrefit {

void Robustify(const FitOptions& options, const StopToken& stop, RefineProblem* problem,
               RefineEnd* end) {
  constexpr int kRounds = 50;
  const std::vector<double> given = problem->weights;
  RefineOptions how;
  how.stop = stop;
  for (int round = 0; round < kRounds && !stop.Stopped(); ++round) {
    std::vector<double> residual(given.size());
    ModelCurrents(problem->device, problem->objective, end->p.data(),
                  {problem->voltage_V, problem->current_A, problem->points}, *problem->kernel,
                  residual.data(), nullptr);
    for (std::size_t k = 0; k < given.size(); ++k) {
      residual[k] = (residual[k] - problem->current_A[k]) * std::sqrt(given[k]);
    }
    const double unit = RobustScale(residual) * options.loss_scale;
    if (!(unit > 0)) return;
    std::vector<double> weights;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const double u = std::fabs(residual[k]) / unit;
      weights.push_back(given[k] *
                        (options.loss == Loss::kHuber ? std::min(1.0, 1 / u) : 1 / (1 + u * u)));
    }
    const Kernel* kernel = problem->kernel;
    *problem =
        MakeRefineProblem(problem->device, problem->objective, problem->voltage_V,
                          problem->current_A, std::move(weights), problem->lower, problem->upper);
    problem->kernel = kernel;
    const std::vector<double> before = end->p;
    *end = Refine(*problem, end->p, how);
    double moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      moved = std::max(moved, std::fabs(end->p[i] - before[i]) / (std::fabs(before[i]) + 1e-300));
    }
    if (moved < 1e-9) return;
  }
}

}  // namespace lyrefit
