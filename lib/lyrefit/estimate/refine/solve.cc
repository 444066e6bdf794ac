#include "lyrefit/estimate/refine/solve.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "lyrefit/estimate/refine/least_squares.h"

namespace lyrefit {
namespace {

// A block of residuals over two blocks of unknowns: the coordinates, then its local unknowns.
// Either may be missing.
class BlockCost : public ceres::CostFunction {
 public:
  BlockCost(const FitModel& model, const Coordinates& coordinates, int block, double unit_A)
      : model_(model), coordinates_(coordinates), block_(block), unit_A_(unit_A) {
    const FitBlock& size = model.shape().blocks[block];
    set_num_residuals(size.residuals);
    if (coordinates.size() > 0) mutable_parameter_block_sizes()->push_back(coordinates.size());
    if (size.locals > 0) mutable_parameter_block_sizes()->push_back(size.locals);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const bool shared = coordinates_.size() > 0;
    const std::size_t own = shared ? 1 : 0;
    const bool local = parameter_block_sizes().size() > own;
    const bool slopes = jacobians != nullptr;
    return EvaluateBlock(model_, coordinates_, block_, shared ? x[0] : nullptr,
                         local ? x[own] : nullptr, unit_A_, residuals,
                         slopes && shared ? jacobians[0] : nullptr,
                         slopes && local ? jacobians[own] : nullptr);
  }

 private:
  const FitModel& model_;
  const Coordinates& coordinates_;
  int block_;
  double unit_A_;
};

// Ends a solve at a stop request, or if the sum of squares is low enough.
class StopAsked : public ceres::IterationCallback {
 public:
  explicit StopAsked(const SolveOptions& options) : options_(options) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const bool end = options_.stop.Stopped() || 2 * summary.cost <= options_.target;
    return end ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const SolveOptions& options_;
};

void SetBounds(const Coordinates& coordinates, std::vector<double>* theta, ceres::Problem* solver) {
  for (int k = 0; k < coordinates.size(); ++k) {
    const double lower = coordinates.lower(k), upper = coordinates.upper(k);
    if (std::isfinite(lower)) solver->SetParameterLowerBound(theta->data(), k, lower);
    if (std::isfinite(upper)) solver->SetParameterUpperBound(theta->data(), k, upper);
    (*theta)[k] = std::min(std::max((*theta)[k], lower), upper);
  }
}

ceres::Solver::Options CeresOptions(const SolveOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = 1e-15;
  solver.parameter_tolerance = 1e-15;
  solver.initial_trust_region_radius = options.trust_radius;
  solver.logging_type = ceres::SILENT;
  solver.max_num_consecutive_invalid_steps = 20;
  return solver;
}

constexpr int kMostSmall = 12;  // coordinates

// Solves all blocks, one below the other, in the coordinates.
SolveEnd SolveSmall(const FitModel& model, const Coordinates& coordinates,
                    const SolveOptions& options) {
  LeastSquaresProblem problem;
  for (const FitBlock& block : model.shape().blocks) problem.residuals += block.residuals;
  for (int k = 0; k < coordinates.size(); ++k) {
    problem.lower.push_back(options.bounded ? coordinates.lower(k) : -HUGE_VAL);
    problem.upper.push_back(options.bounded ? coordinates.upper(k) : HUGE_VAL);
  }
  problem.evaluate = [&](const double* theta, double* residuals, double* jacobian) {
    const int blocks = static_cast<int>(model.shape().blocks.size());
    for (int b = 0; b < blocks; ++b) {
      if (!EvaluateBlock(model, coordinates, b, theta, nullptr, options.unit_A, residuals, jacobian,
                         nullptr)) {
        return false;
      }
      const int rows = model.shape().blocks[b].residuals;
      residuals += rows;
      jacobian += static_cast<std::ptrdiff_t>(rows) * coordinates.size();
    }
    return true;
  };
  LeastSquaresOptions how;
  how.max_iterations = options.max_iterations;
  how.function_tolerance = options.function_tolerance;
  how.trust_radius = options.trust_radius;
  how.cutoff = options.cutoff;
  how.target = options.target;
  how.stop = options.stop;
  LeastSquaresEnd found = SolveLeastSquares(problem, coordinates.Start(), how);
  return {std::move(found.p), {}, found.converged, found.stopped, found.hopeless, found.iterations};
}

}  // namespace

SolveEnd SolveModel(const FitModel& model, const Coordinates& coordinates,
                    std::vector<double> local, const SolveOptions& options) {
  const bool small = local.empty() && coordinates.size() > 0 && coordinates.size() <= kMostSmall;
  if (options.small && small) return SolveSmall(model, coordinates, options);
  SolveEnd end;
  end.theta = coordinates.Start();
  end.local = std::move(local);
  end.converged = end.theta.empty() && end.local.empty();  // nothing to find
  // Ceres writes to the log if it receives a number that is not finite.
  if (end.converged || !AllFinite(end.theta.data(), end.theta.size()) ||
      !AllFinite(end.local.data(), end.local.size()))
    return end;
  ceres::Problem solver;
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  // All local unknowns are contiguous in memory, since Ceres orders eliminated blocks by address.
  // With separate allocations the last bits of a fit would depend on those addresses.
  double* own = end.local.data();
  for (std::size_t b = 0; b < model.shape().blocks.size(); ++b) {
    const int locals = model.shape().blocks[b].locals;
    std::vector<double*> unknowns;
    if (!end.theta.empty()) unknowns.push_back(end.theta.data());
    if (locals > 0) unknowns.push_back(own);
    if (locals > 0) order->AddElementToGroup(own, 0);
    own += locals;
    if (unknowns.empty()) continue;
    solver.AddResidualBlock(new BlockCost(model, coordinates, static_cast<int>(b), options.unit_A),
                            nullptr, unknowns);
  }
  if (options.bounded) SetBounds(coordinates, &end.theta, &solver);
  ceres::Solver::Options how = CeresOptions(options);
  if (!end.theta.empty() && !end.local.empty()) {
    order->AddElementToGroup(end.theta.data(), 1);
    how.linear_solver_ordering = order;
    how.linear_solver_type = ceres::DENSE_SCHUR;
  }
  StopAsked stop(options);
  how.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(how, &solver, &summary);
  end.iterations = static_cast<int>(summary.iterations.size());
  end.converged = summary.termination_type == ceres::CONVERGENCE;
  end.stopped = options.stop.requested();
  return end;
}

}  // namespace lyrefit
