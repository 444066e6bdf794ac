#include "lyrefit/refine/joint_solve.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lyrefit/refine/finite.h"
#include "lyrefit/refine/joint_residuals.h"

namespace lyrefit {
namespace {

class CurveCost : public ceres::CostFunction {
 public:
  CurveCost(const JointProblem& problem, const JointCoordinates& coordinates, int curve,
            double unit_A)
      : problem_(problem), coordinates_(coordinates), curve_(curve), unit_A_(unit_A) {
    const JointShape shape = ShapeOf(problem.curves[curve]);
    set_num_residuals(shape.residuals);
    if (coordinates.size() > 0) mutable_parameter_block_sizes()->push_back(coordinates.size());
    if (shape.locals > 0) mutable_parameter_block_sizes()->push_back(shape.locals);
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    // Blocks: what is shared, then the curve's own unknowns; either may be missing.
    const bool has_shared = coordinates_.size() > 0;
    const std::size_t own = has_shared ? 1 : 0;
    const bool has_local = parameter_block_sizes().size() > own;
    RowMatrix shared, local;
    const bool want_shared = jacobians != nullptr && has_shared && jacobians[0] != nullptr;
    const bool want_local = jacobians != nullptr && has_local && jacobians[own] != nullptr;
    if (!EvaluateJointCurve(problem_, coordinates_, curve_, has_shared ? x[0] : nullptr,
                            has_local ? x[own] : nullptr, unit_A_, residuals,
                            want_shared ? &shared : nullptr, want_local ? &local : nullptr)) {
      return false;
    }
    if (want_shared && !AllFinite(shared.data(), shared.size())) return false;
    if (want_local && !AllFinite(local.data(), local.size())) return false;
    if (want_shared) std::copy(shared.data(), shared.data() + shared.size(), jacobians[0]);
    if (want_local) std::copy(local.data(), local.data() + local.size(), jacobians[own]);
    return true;
  }

 private:
  const JointProblem& problem_;
  const JointCoordinates& coordinates_;
  int curve_;
  double unit_A_;
};

void SetBounds(const JointCoordinates& coordinates, std::vector<double>* theta,
               ceres::Problem* solver) {
  for (int k = 0; k < coordinates.size(); ++k) {
    double lower, upper;
    coordinates.Bounds(k, &lower, &upper);
    if (std::isfinite(lower)) solver->SetParameterLowerBound(theta->data(), k, lower);
    if (std::isfinite(upper)) solver->SetParameterUpperBound(theta->data(), k, upper);
  }
}

ceres::Solver::Options SolverOptions(const JointOptions& options) {
  ceres::Solver::Options solver;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = 1e-15;
  solver.parameter_tolerance = 1e-14;
  solver.initial_trust_region_radius = 1e6;
  solver.logging_type = ceres::SILENT;
  solver.max_num_consecutive_invalid_steps = 20;
  return solver;
}

}  // namespace

std::vector<double> StartInside(const JointCoordinates& coordinates) {
  std::vector<double> theta = coordinates.Start();
  for (int k = 0; k < coordinates.size(); ++k) {
    double lower, upper;
    coordinates.Bounds(k, &lower, &upper);
    theta[k] = std::min(std::max(theta[k], lower), upper);
  }
  return theta;
}

JointStep SolveJointly(const JointProblem& problem, const JointCoordinates& coordinates,
                       const JointPoint& start, const JointStepOptions& how,
                       const JointOptions& options) {
  std::vector<double> theta = StartInside(coordinates);
  // In one block, since Ceres orders what it eliminates by address: in pieces, the last bits of a
  // fit would hang on where they happened to lie.
  std::vector<JointLocal> locals(problem.curves.size());
  ceres::Problem solver;
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  bool any_local = false;
  for (std::size_t c = 0; c < locals.size(); ++c) {
    const JointShape shape = ShapeOf(problem.curves[c]);
    const std::vector<double> packed = PackLocal(shape, start.local[c]);
    std::copy(packed.begin(), packed.end(), locals[c].begin());
    std::vector<double*> blocks;
    if (!theta.empty()) blocks.push_back(theta.data());
    if (shape.locals > 0) {
      blocks.push_back(locals[c].data());
      order->AddElementToGroup(locals[c].data(), 0);
      any_local = true;
    }
    if (blocks.empty()) continue;
    solver.AddResidualBlock(new CurveCost(problem, coordinates, static_cast<int>(c), how.unit_A),
                            nullptr, blocks);
  }
  JointStep step;
  step.point = start;
  for (const JointLocal& local : locals) {
    if (!AllFinite(local.data(), local.size())) return step;
  }
  if (!AllFinite(theta.data(), theta.size())) return step;
  step.converged = theta.empty() && !any_local;  // nothing to find
  if (step.converged) return step;
  if (!theta.empty()) order->AddElementToGroup(theta.data(), 1);
  if (how.bounded) SetBounds(coordinates, &theta, &solver);
  ceres::Solver::Options solving = SolverOptions(options);
  solving.linear_solver_ordering = order;
  solving.linear_solver_type = any_local && !theta.empty() ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
  ceres::Solver::Summary summary;
  ceres::Solve(solving, &solver, &summary);
  step.iterations = static_cast<int>(summary.iterations.size());
  step.converged = summary.termination_type == ceres::CONVERGENCE;
  coordinates.ToShared(theta.data(), step.point.shared.data());
  for (std::size_t c = 0; c < locals.size(); ++c) {
    step.point.local[c] = UnpackLocal(ShapeOf(problem.curves[c]), locals[c]);
  }
  return step;
}

}  // namespace lyrefit
