#include "lyrefit/refine/joint.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lyrefit/refine/joint_linear.h"
#include "lyrefit/refine/joint_residuals.h"

namespace lyrefit {
namespace {

constexpr double kFlat = 1e-9;  // cosine below which a held parameter does not want back

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

class JointPolish {
 public:
  JointPolish(const JointProblem& problem, JointPoint start, const JointOptions& options)
      : problem_(problem), options_(options), at_(std::move(start)) {
    at_.local.resize(problem.curves.size(), {0, 0});
    for (int i = 0; i < problem.shared(); ++i) {
      fixed_.push_back(problem.lower[i] == problem.upper[i]);
      at_.shared[i] = std::min(std::max(at_.shared[i], problem.lower[i]), problem.upper[i]);
    }
    held_ = fixed_;
    refused_.assign(problem.shared(), false);
    // Into the bounds that only coordinates have.
    const JointCoordinates coordinates(problem, at_.shared, held_);
    std::vector<double> theta = coordinates.Start();
    ClampInto(coordinates, &theta);
    MoveTo(coordinates, theta);
  }

  JointEnd Run() {
    Solve(/*bounded=*/true);
    HoldWhatPresses();
    State best;
    for (int round = 0; round < options_.max_rounds; ++round) {
      if (!SolveFree()) continue;
      if (cost_ < best.cost) {
        best = {at_, held_, cost_, converged_};
      } else {  // what was let in led nowhere
        Restore(best);
        if (last_released_ >= 0) refused_[last_released_] = true;
      }
      if (!ReleaseOne()) break;
    }
    if (best.cost < cost_) Restore(best);
    JointEnd end;
    end.point = at_;
    end.held = held_;
    end.converged = converged_;
    end.iterations = iterations_;
    for (std::size_t c = 0; c < problem_.curves.size(); ++c) AddSquares(static_cast<int>(c), &end);
    end.projected_gradient = ProjectedGradient();
    return end;
  }

 private:
  struct State {
    JointPoint at;
    std::vector<bool> held;
    double cost = HUGE_VAL;
    bool converged = false;
  };
  void Restore(const State& state) {
    if (state.held.empty()) return;
    at_ = state.at;
    held_ = state.held;
    cost_ = state.cost;
    converged_ = state.converged;
  }

  void AddSquares(int c, JointEnd* end) const {
    std::vector<double> residuals = Residuals(at_, c);
    const std::size_t points = problem_.curves[c].voltage_V.size();
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      (k < points ? end->squares : end->prior_squares) += residuals[k] * residuals[k];
    }
  }

  std::vector<double> Residuals(const JointPoint& point, int c) const {
    const JointShape shape = ShapeOf(problem_.curves[c]);
    const JointCoordinates coordinates(problem_, point.shared, held_);
    const std::vector<double> theta = coordinates.Start();
    std::vector<double> residuals(shape.residuals);
    const std::vector<double> local = Pack(shape, point.local[c]);
    const bool sound = EvaluateJointCurve(problem_, coordinates, c, theta.data(), local.data(), 1.0,
                                          residuals.data(), nullptr, nullptr);
    if (!sound) std::fill(residuals.begin(), residuals.end(), HUGE_VAL);
    return residuals;
  }

  double Cost(const JointPoint& point) const {
    double cost = 0;
    for (std::size_t c = 0; c < problem_.curves.size(); ++c) {
      for (const double r : Residuals(point, static_cast<int>(c))) cost += r * r;
    }
    return std::isfinite(cost) ? cost : HUGE_VAL;
  }

  static std::vector<double> Pack(const JointShape& shape, const JointLocal& local) {
    std::vector<double> packed;
    if (shape.irradiance) packed.push_back(local[0]);
    if (shape.temperature) packed.push_back(local[1]);
    return packed;
  }
  static JointLocal Unpack(const JointShape& shape, const JointLocal& packed) {
    JointLocal local = {0, 0};
    std::size_t next = 0;
    if (shape.irradiance) local[0] = packed[next++];
    if (shape.temperature) local[1] = packed[next++];
    return local;
  }

  // One Ceres solve over what is not held; keeps the better of before and after.
  void Solve(bool bounded) {
    const JointCoordinates coordinates(problem_, at_.shared, held_);
    converged_ = coordinates.size() == 0 && !HasLocals();
    if (converged_ || !std::isfinite(cost_)) return;  // from nowhere there is no way
    std::vector<double> theta = coordinates.Start();
    ClampInto(coordinates, &theta);
    const double points = std::max<double>(1, static_cast<double>(PointCount()));
    const double unit_A = std::max(std::sqrt(cost_ / points), 1e-13 * Scale());
    ceres::Problem solver;
    // In one block, since Ceres orders what it eliminates by address: in pieces, the last bits of a
    // fit would hang on where they happened to lie.
    std::vector<JointLocal> locals(problem_.curves.size());
    auto* order = new ceres::ParameterBlockOrdering;
    for (std::size_t c = 0; c < problem_.curves.size(); ++c) {
      const JointShape shape = ShapeOf(problem_.curves[c]);
      const std::vector<double> packed = Pack(shape, at_.local[c]);
      std::copy(packed.begin(), packed.end(), locals[c].begin());
      auto cost =
          std::make_unique<CurveCost>(problem_, coordinates, static_cast<int>(c), unit_A);
      std::vector<double*> blocks;
      if (!theta.empty()) blocks.push_back(theta.data());
      if (shape.locals > 0) blocks.push_back(locals[c].data());
      if (!blocks.empty()) solver.AddResidualBlock(cost.release(), nullptr, blocks);
      if (shape.locals > 0) order->AddElementToGroup(locals[c].data(), 0);
    }
    if (!theta.empty()) order->AddElementToGroup(theta.data(), 1);
    if (bounded) SetBounds(coordinates, &theta, &solver);
    ceres::Solver::Options options = SolverOptions();
    options.linear_solver_ordering.reset(order);
    options.linear_solver_type = HasLocals() && !theta.empty() ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &solver, &summary);
    iterations_ += static_cast<int>(summary.iterations.size());
    converged_ = summary.termination_type == ceres::CONVERGENCE;
    JointPoint end = at_;
    coordinates.ToShared(theta.data(), end.shared.data());
    for (std::size_t c = 0; c < locals.size(); ++c) {
      end.local[c] = Unpack(ShapeOf(problem_.curves[c]), locals[c]);
    }
    const double cost = Cost(end);
    if (cost <= cost_) {
      at_ = std::move(end);
      cost_ = cost;
    }
  }

  ceres::Solver::Options SolverOptions() const {
    ceres::Solver::Options options;
    options.max_num_iterations = options_.max_iterations;
    options.function_tolerance = options_.function_tolerance;
    options.gradient_tolerance = 1e-15;
    options.parameter_tolerance = 1e-14;
    options.initial_trust_region_radius = 1e6;
    options.logging_type = ceres::SILENT;
    options.max_num_consecutive_invalid_steps = 20;
    return options;
  }

  bool HasLocals() const {
    return std::any_of(problem_.curves.begin(), problem_.curves.end(),
                       [](const JointCurve& curve) { return ShapeOf(curve).locals > 0; });
  }
  double Scale() const { return problem_.current_scale_A; }
  std::size_t PointCount() const {
    std::size_t points = 0;
    for (const JointCurve& curve : problem_.curves) points += curve.voltage_V.size();
    return points;
  }

  static void ClampInto(const JointCoordinates& coordinates, std::vector<double>* theta) {
    for (int k = 0; k < coordinates.size(); ++k) {
      double lower, upper;
      coordinates.Bounds(k, &lower, &upper);
      (*theta)[k] = std::min(std::max((*theta)[k], lower), upper);
    }
  }

  static void SetBounds(const JointCoordinates& coordinates, std::vector<double>* theta,
                        ceres::Problem* solver) {
    for (int k = 0; k < coordinates.size(); ++k) {
      double lower, upper;
      coordinates.Bounds(k, &lower, &upper);
      if (std::isfinite(lower)) solver->SetParameterLowerBound(theta->data(), k, lower);
      if (std::isfinite(upper)) solver->SetParameterUpperBound(theta->data(), k, upper);
    }
  }

  // Holds parameter i where it is; a faded second diode takes its n along.
  void Hold(int i) {
    held_[i] = true;
    const Translation& at = problem_.translation;
    if (i == at.saturation_current_2 && i >= 0) held_[at.n_2] = true;
  }

  void MoveTo(const JointCoordinates& coordinates, const std::vector<double>& theta) {
    coordinates.ToShared(theta.data(), at_.shared.data());
    cost_ = Cost(at_);
  }

  void HoldWhatPresses() {
    const JointCoordinates coordinates(problem_, at_.shared, held_);
    std::vector<double> theta = coordinates.Start();
    const JointLinear now = LinearizeJointly(problem_, at_, held_);
    std::vector<int> pressed;
    for (int k = 0; k < coordinates.size(); ++k) {
      double lower, upper;
      coordinates.Bounds(k, &lower, &upper);
      const double slope = now.shared.col(k).dot(now.residual);
      const double near = 1e-6 * (1 + std::fabs(theta[k]));
      const bool low = theta[k] - lower < near && slope >= 0;
      const bool high = upper - theta[k] < near && slope <= 0;
      if (!low && !high) continue;
      theta[k] = low ? lower : upper;
      pressed.push_back(coordinates.parameter(k));
    }
    if (pressed.empty()) return;
    MoveTo(coordinates, theta);
    for (const int i : pressed) Hold(i);
  }

  // Solves without bounds; true if the answer lies inside them, else stops at the first bound on
  // the way and holds that parameter.
  bool SolveFree() {
    const JointCoordinates coordinates(problem_, at_.shared, held_);
    const std::vector<double> before = coordinates.Start();
    const JointPoint start = at_;
    Solve(/*bounded=*/false);
    const JointCoordinates after(problem_, at_.shared, held_);
    std::vector<double> theta = after.Start();
    int first = -1;
    double reach = 1, bound = 0;
    for (int k = 0; k < coordinates.size(); ++k) {
      double lower, upper;
      coordinates.Bounds(k, &lower, &upper);
      if (theta[k] >= lower && theta[k] <= upper) continue;
      const double end = theta[k] < lower ? lower : upper;
      const double way = theta[k] - before[k];
      const double fraction = way != 0 ? (end - before[k]) / way : 0;
      if (first >= 0 && fraction >= reach) continue;
      first = k;
      reach = std::min(std::max(fraction, 0.0), 1.0);
      bound = end;
    }
    if (first < 0) return true;
    for (std::size_t k = 0; k < theta.size(); ++k) {
      theta[k] = before[k] + reach * (theta[k] - before[k]);
    }
    for (std::size_t c = 0; c < at_.local.size(); ++c) {
      for (int which : {0, 1}) {
        double& value = at_.local[c][which];
        value = start.local[c][which] + reach * (value - start.local[c][which]);
      }
    }
    theta[first] = bound;
    MoveTo(coordinates, theta);
    Hold(coordinates.parameter(first));
    return false;
  }

  // Held parameters that are not fixed, with a diode that is there.
  std::vector<bool> FixedOrFaded() const {
    std::vector<bool> held = fixed_;
    const Translation& at = problem_.translation;
    if (at.saturation_current_2 >= 0 && held_[at.saturation_current_2]) held[at.n_2] = true;
    return held;
  }

  // Cosines of the columns that may move downhill, 0 for those that press against their bound.
  std::vector<double> FreeCosines(const JointLinear& now, const std::vector<bool>& held) const {
    const JointCoordinates coordinates(problem_, at_.shared, held);
    const std::vector<double> theta = coordinates.Start();
    std::vector<double> cosines(theta.size(), 0);
    const double norm = now.residual.norm();
    for (int k = 0; k < coordinates.size(); ++k) {
      const double column = now.shared.col(k).norm();
      if (!(column > 0) || !(norm > 0)) continue;
      const double cosine = now.shared.col(k).dot(now.residual) / (column * norm);
      if (held_[coordinates.parameter(k)]) {
        double lower, upper;
        coordinates.Bounds(k, &lower, &upper);
        const bool low = theta[k] - lower < upper - theta[k];
        if (low ? cosine >= 0 : cosine <= 0) continue;
      }
      cosines[k] = cosine;
    }
    return cosines;
  }

  double ProjectedGradient() const {
    const std::vector<bool> held = FixedOrFaded();
    double largest = 0;
    for (const double cosine : FreeCosines(LinearizeJointly(problem_, at_, held), held)) {
      largest = std::max(largest, std::fabs(cosine));
    }
    return largest;
  }

  bool ReleaseOne() {
    const std::vector<bool> held = FixedOrFaded();
    const JointLinear now = LinearizeJointly(problem_, at_, held);
    const std::vector<double> cosines = FreeCosines(now, held);
    int best = -1;
    double largest = kFlat;
    for (std::size_t k = 0; k < cosines.size(); ++k) {
      const int i = now.parameter[k];
      if (!held_[i] || refused_[i] || std::fabs(cosines[k]) <= largest) continue;
      largest = std::fabs(cosines[k]);
      best = now.parameter[k];
    }
    if (best < 0 || ++released_ > problem_.shared()) return false;
    held_[best] = fixed_[best];
    last_released_ = best;
    if (best == problem_.translation.saturation_current_2) LetDiodeIn();
    return true;
  }

  // From 1e-11 of the current no step would lead anywhere: begins at a size that shows.
  void LetDiodeIn() {
    constexpr double kVisible = -7;
    const Translation& at = problem_.translation;
    held_[at.n_2] = fixed_[at.n_2];
    const JointCoordinates coordinates(problem_, at_.shared, held_);
    std::vector<double> theta = coordinates.Start();
    for (int k = 0; k < coordinates.size(); ++k) {
      if (coordinates.parameter(k) == at.saturation_current_2) theta[k] = kVisible;
    }
    MoveTo(coordinates, theta);
  }

  const JointProblem& problem_;
  const JointOptions& options_;
  JointPoint at_;
  std::vector<bool> fixed_;
  std::vector<bool> held_;
  double cost_ = HUGE_VAL;
  bool converged_ = false;
  int iterations_ = 0;
  int released_ = 0;
  int last_released_ = -1;
  std::vector<bool> refused_;  // let in once, and the fit was no better for it
};

}  // namespace

void FindJointScales(JointProblem* problem) {
  problem->current_scale_A = 0;
  problem->voltage_scale_V = 0;
  for (const JointCurve& curve : problem->curves) {
    for (std::size_t k = 0; k < curve.voltage_V.size(); ++k) {
      problem->current_scale_A = std::max(problem->current_scale_A, std::fabs(curve.current_A[k]));
      problem->voltage_scale_V = std::max(problem->voltage_scale_V, curve.voltage_V[k]);
    }
  }
}

TrueConditions ConditionsAt(const JointProblem& problem, const JointPoint& point, int curve) {
  const JointCurve& at = problem.curves[curve];
  return {
      at.irradiance_W_m2 * (1 + point.local[curve][0]) + point.shared[problem.irradiance_offset()],
      at.temperature_K + point.local[curve][1] + point.shared[problem.temperature_offset()]};
}

std::vector<double> DeviceAt(const JointProblem& problem, const JointPoint& point, int curve) {
  const TrueConditions at = ConditionsAt(problem, point, curve);
  std::vector<double> device(problem.translation.device.size());
  Translate(problem.translation, point.shared.data(), at.irradiance_W_m2, at.temperature_K,
            device.data());
  return device;
}

JointEnd RefineJointly(const JointProblem& problem, JointPoint start, const JointOptions& options) {
  return JointPolish(problem, std::move(start), options).Run();
}

}  // namespace lyrefit
