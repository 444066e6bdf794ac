#include "lyrefit/refine/joint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/refine/joint_linear.h"
#include "lyrefit/refine/joint_residuals.h"
#include "lyrefit/refine/joint_solve.h"

namespace lyrefit {
namespace {

constexpr double kFlatJoint = 1e-9;  // cosine below which a held parameter does not want back

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
    MoveTo(coordinates, StartInside(coordinates));
  }

  JointEnd Run() {
    Solve(/*bounded=*/true);
    HoldWhatPresses();
    State best;
    for (int round = 0; round < options_.max_rounds && !stopped_; ++round) {
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
    end.stopped = stopped_;
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
    const std::vector<double> local = PackLocal(shape, point.local[c]);
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

  // One Ceres solve over what is not held; keeps the better of before and after.
  void Solve(bool bounded) {
    const JointCoordinates coordinates(problem_, at_.shared, held_);
    converged_ = false;
    if (!std::isfinite(cost_)) return;  // from nowhere there is no way
    stopped_ = stopped_ || (options_.proceed && !options_.proceed());
    if (stopped_) return;
    double points = 0;
    for (const JointCurve& curve : problem_.curves) {
      points += static_cast<double>(curve.voltage_V.size());
    }
    const double least = 1e-13 * problem_.current_scale_A;
    const double unit_A = std::max(std::sqrt(cost_ / std::max(points, 1.0)), least);
    JointStep step = SolveJointly(problem_, coordinates, at_, {unit_A, bounded}, options_);
    iterations_ += step.iterations;
    converged_ = step.converged;
    stopped_ = step.stopped;
    const double cost = Cost(step.point);
    if (cost <= cost_) {
      at_ = std::move(step.point);
      cost_ = cost;
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
      const bool low = theta[k] - lower < near && slope > 0;
      const bool high = upper - theta[k] < near && slope < 0;
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
    double largest = kFlatJoint;
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
  bool stopped_ = false;
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
