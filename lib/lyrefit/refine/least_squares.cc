#include "lyrefit/refine/least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/refine/finite.h"

namespace lyrefit {
namespace {

// The moving parameters of a problem as one block.
class Cost : public ceres::CostFunction {
 public:
  Cost(const LeastSquaresProblem& problem, const std::vector<int>& moving,
       const std::vector<double>& start)
      : problem_(problem), moving_(moving), p_(start) {
    set_num_residuals(problem.residuals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(moving.size()));
    jacobian_.resize(static_cast<std::size_t>(problem.residuals) * start.size());
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (std::size_t k = 0; k < moving_.size(); ++k) p_[moving_[k]] = x[0][k];
    const bool slopes = jacobians != nullptr && jacobians[0] != nullptr;
    if (!problem_.evaluate(p_.data(), residuals, slopes ? jacobian_.data() : nullptr)) return false;
    if (!AllFinite(residuals, problem_.residuals)) return false;
    if (!slopes) return true;
    double* to = jacobians[0];
    if (!AllFinite(jacobian_.data(), jacobian_.size())) return false;
    for (int i = 0; i < problem_.residuals; ++i) {
      const double* row = jacobian_.data() + static_cast<std::size_t>(i) * p_.size();
      for (const int k : moving_) *to++ = row[k];
    }
    return true;
  }

 private:
  const LeastSquaresProblem& problem_;
  const std::vector<int>& moving_;
  mutable std::vector<double> p_;
  mutable std::vector<double> jacobian_;
};

std::vector<int> Moving(const LeastSquaresProblem& problem) {
  std::vector<int> moving;
  for (std::size_t k = 0; k < problem.lower.size(); ++k) {
    if (problem.held.empty() || problem.held[k] == 0) moving.push_back(static_cast<int>(k));
  }
  return moving;
}

ceres::Solver::Options SolverOptions(const LeastSquaresOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-12;
  solver.initial_trust_region_radius = 1e4;
  solver.max_num_consecutive_invalid_steps = 20;
  solver.logging_type = ceres::SILENT;
  return solver;
}

// A bounded solve stops a little short where a bound is active: what is pressed against one is held
// there and the rest solved once more.
LeastSquaresEnd SolveWithinBounds(const LeastSquaresProblem& problem, LeastSquaresEnd end,
                                  const LeastSquaresOptions& options) {
  LeastSquaresProblem rest = problem;
  rest.held.assign(problem.lower.size(), 0);
  std::vector<double> start = end.p;
  bool pressed = false, moving = false;
  for (std::size_t k = 0; k < start.size(); ++k) {
    const bool held = !problem.held.empty() && problem.held[k] != 0;
    const double near = 1e-4 * std::min(problem.upper[k] - problem.lower[k], 1.0);
    const bool low = start[k] - problem.lower[k] < near, high = problem.upper[k] - start[k] < near;
    if (!held && (low || high)) {
      start[k] = low ? problem.lower[k] : problem.upper[k];
      pressed = true;
    }
    rest.held[k] = held || low || high ? 1 : 0;
    moving = moving || rest.held[k] == 0;
  }
  if (!pressed || !moving) return end;
  LeastSquaresEnd again = SolveLeastSquares(rest, start, options);
  if (!again.usable || again.sum_of_squares >= end.sum_of_squares) return end;
  again.iterations += end.iterations;
  return again;
}

}  // namespace

LeastSquaresEnd SolveLeastSquares(const LeastSquaresProblem& problem,
                                  const std::vector<double>& start,
                                  const LeastSquaresOptions& options) {
  LeastSquaresEnd end;
  end.p = start;
  const std::vector<int> moving = Moving(problem);
  std::vector<double> x;
  for (const int k : moving) {
    end.p[k] = std::min(std::max(start[k], problem.lower[k]), problem.upper[k]);
    x.push_back(end.p[k]);
  }
  std::vector<double> residuals(problem.residuals);
  if (!AllFinite(end.p.data(), end.p.size())) return end;
  if (!problem.evaluate(end.p.data(), residuals.data(), nullptr)) return end;
  end.usable = true;
  for (const double r : residuals) end.sum_of_squares += r * r;
  if (moving.empty()) {
    end.converged = true;
    return end;
  }
  ceres::Problem solver;
  solver.AddResidualBlock(new Cost(problem, moving, end.p), nullptr, x.data());
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const int at = static_cast<int>(k);
    if (std::isfinite(problem.lower[moving[k]])) {
      solver.SetParameterLowerBound(x.data(), at, problem.lower[moving[k]]);
    }
    if (std::isfinite(problem.upper[moving[k]])) {
      solver.SetParameterUpperBound(x.data(), at, problem.upper[moving[k]]);
    }
  }
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options), &solver, &summary);
  end.iterations = static_cast<int>(summary.iterations.size());
  end.converged = summary.termination_type == ceres::CONVERGENCE;
  if (2 * summary.final_cost <= end.sum_of_squares) {
    end.sum_of_squares = 2 * summary.final_cost;
    for (std::size_t k = 0; k < moving.size(); ++k) end.p[moving[k]] = x[k];
  }
  return SolveWithinBounds(problem, std::move(end), options);
}

}  // namespace lyrefit
