#include "lyrefit/refine/least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

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
    if (!slopes) return true;
    double* to = jacobians[0];
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
  return end;
}

}  // namespace lyrefit
