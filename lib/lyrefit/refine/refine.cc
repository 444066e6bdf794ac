#include "lyrefit/refine/refine.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/refine/finite.h"
#include "lyrefit/refine/jacobian.h"
#include "lyrefit/refine/polish_cost.h"
#include "lyrefit/refine/separable.h"
#include "lyrefit/refine/stop_asked.h"
#include "lyrefit/refine/thin.h"

namespace lyrefit {
namespace {

// A diode that adds less than this part of the curve's current anywhere has faded.
constexpr double kFaded = 1e-9;
// Cosine below which a gradient counts as zero when a bound is released or a diode let in.
constexpr double kFlat = 1e-8;
// Relative rise of the mean square, from the best point on the way to the end, that is no rounding.
constexpr double kWorse = 1e-9;

class Polish {
 public:
  Polish(const RefineProblem& problem, std::vector<double> start, const RefineOptions& options)
      : problem_(problem), options_(options), p_(std::move(start)), held_(p_.size()) {
    CHECK_EQ(static_cast<int>(p_.size()), problem.device.size());
    for (int i = 0; i < size(); ++i) {
      p_[i] = std::min(std::max(p_[i], problem.lower[i]), problem.upper[i]);
      held_[i] = problem.fixed(i);
    }
    mean_square_ = MeanSquare(problem_, p_);
    Remember();
    RemoveFadedDiodes();
    mean_square_ = MeanSquare(problem_, p_);
  }

  RefineEnd Run() {
    if (!Ended()) Solve(/*bounded=*/true, std::max(options_.function_tolerance, 1e-9), 40);
    Remember();
    bool settled = false;
    for (int round = 0; round < options_.max_rounds && !settled && !Ended(); ++round) {
      HoldWhatPresses();
      settled = SolveFree() && !ReleaseOne() && !LetDiodeIn();
      Remember();
    }
    return End(settled && solver_converged_);
  }

  RefineEnd RunPlainly() {
    Solve(/*bounded=*/true, options_.function_tolerance, options_.max_iterations);
    return End(solver_converged_);
  }

 private:
  bool Ended() const { return stop_.stopped() || mean_square_ <= options_.enough; }

  // Holding and letting go may lead uphill on a curve that the model does not describe.
  void Remember() {
    if (!best_p_.empty() && !(mean_square_ < best_mean_square_)) return;
    best_p_ = p_;
    best_held_ = held_;
    best_mean_square_ = mean_square_;
  }

  RefineEnd End(bool converged) {
    if (!(mean_square_ <= best_mean_square_ * (1 + kWorse))) {
      p_ = best_p_;
      held_ = best_held_;
      mean_square_ = best_mean_square_;
      converged = false;
    }
    RefineEnd end;
    end.p = p_;
    end.held = held_;
    end.mean_square = mean_square_;
    end.iterations = iterations_;
    end.projected_gradient = ProjectedGradient();
    end.converged = converged;
    return end;
  }

  int size() const { return problem_.device.size(); }
  bool vanished(int is) const { return held_[is] && p_[is] <= 0; }

  // One Ceres solve over what is not held; keeps the better of before and after.
  void Solve(bool bounded, double function_tolerance, int max_iterations) {
    const Coordinates coordinates(problem_, p_, held_);
    if (coordinates.size() == 0) {
      solver_converged_ = true;
      return;
    }
    std::vector<double> theta = coordinates.Start();
    solver_converged_ = false;
    // No place to take a step from.
    if (!AllFinite(theta.data(), theta.size()) || !std::isfinite(mean_square_)) return;
    if (!coordinates.Sane(theta.data())) return;
    const double unit_A = std::max(std::sqrt(mean_square_), 1e-13 * problem_.current_scale_A);
    ceres::Problem ceres_problem;
    ceres_problem.AddResidualBlock(new PolishCost(problem_, coordinates, unit_A), nullptr,
                                   theta.data());
    if (bounded) {
      for (int k = 0; k < coordinates.size(); ++k) {
        double lower, upper;
        coordinates.Bounds(k, &lower, &upper);
        if (std::isfinite(lower)) ceres_problem.SetParameterLowerBound(theta.data(), k, lower);
        if (std::isfinite(upper)) ceres_problem.SetParameterUpperBound(theta.data(), k, upper);
        theta[k] = std::min(std::max(theta[k], lower), upper);
      }
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = max_iterations;
    options.function_tolerance = function_tolerance;
    options.gradient_tolerance = 1e-15;
    options.parameter_tolerance = 1e-15;
    options.initial_trust_region_radius = 1e10;  // starts are good: close to Gauss-Newton steps
    options.logging_type = ceres::SILENT;
    options.max_num_consecutive_invalid_steps = 20;
    options.callbacks.push_back(&stop_);
    stop_.set_enough(0.5 * options_.enough / (unit_A * unit_A) *
                     static_cast<double>(problem_.voltage_V.size()));
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_problem, &summary);
    iterations_ += static_cast<int>(summary.iterations.size());
    solver_converged_ = summary.termination_type == ceres::CONVERGENCE;
    std::vector<double> p(p_.size());
    coordinates.ToParameters(theta.data(), p.data());
    const double mean_square = MeanSquare(problem_, p);
    if (mean_square <= mean_square_) {
      p_ = std::move(p);
      mean_square_ = mean_square;
    }
  }

  // Solves without bounds. True if the answer lies inside them; else goes as far as the first bound
  // on the way there and holds that parameter.
  bool SolveFree() {
    const std::vector<double> before = p_;
    const double mean_square_before = mean_square_;
    Solve(/*bounded=*/false, options_.function_tolerance, options_.max_iterations);
    int first = -1;
    double reach = 1;
    for (int i = 0; i < size(); ++i) {
      // 1 / n or the shunt's conductance went through 0.
      if ((Coordinates::IsIdeality(i) || i == kRsh) && p_[i] <= 0) p_[i] = 1e300;
      if (held_[i] || (p_[i] >= problem_.lower[i] && p_[i] <= problem_.upper[i])) continue;
      const double bound = p_[i] < problem_.lower[i] ? problem_.lower[i] : problem_.upper[i];
      const double fraction = (bound - before[i]) / (p_[i] - before[i]);
      if (first < 0 || fraction < reach) {
        first = i;
        reach = fraction;
      }
    }
    if (first < 0) return true;
    for (int i = 0; i < size(); ++i) {
      if (held_[i]) continue;
      p_[i] = std::min(std::max(before[i] + reach * (p_[i] - before[i]), problem_.lower[i]),
                       problem_.upper[i]);
    }
    Hold(first);
    RemoveFadedDiodes();
    mean_square_ = MeanSquare(problem_, p_);
    if (mean_square_ > mean_square_before) {
      for (int i = 0; i < size(); ++i) {
        if (!held_[i] || i == first) p_[i] = before[i];
      }
      Hold(first);
      mean_square_ = MeanSquare(problem_, p_);
    }
    return false;
  }

  // Puts parameter i on its nearer bound and holds it there.
  void Hold(int i) {
    const double middle = Coordinates::IsSaturation(i) && problem_.lower[i] > 0
                              ? std::sqrt(problem_.lower[i] * problem_.upper[i])
                              : 0.5 * (problem_.lower[i] + problem_.upper[i]);
    p_[i] = p_[i] < middle ? problem_.lower[i] : problem_.upper[i];
    held_[i] = true;
  }

  void HoldWhatPresses() {
    const Linearization now = Linearize(problem_, p_, held_);
    const Coordinates coordinates(problem_, p_, held_);
    const std::vector<double> theta = coordinates.Start();
    for (int k = 0; k < coordinates.size(); ++k) {
      double lower, upper;
      coordinates.Bounds(k, &lower, &upper);
      const double slope = now.jacobian.col(k).dot(now.residual);
      const double near = 1e-6 * (1 + std::fabs(theta[k]));
      const bool pressed =
          (theta[k] - lower < near && slope > 0) || (upper - theta[k] < near && slope < 0);
      if (pressed) Hold(coordinates.parameter(k));
    }
    RemoveFadedDiodes();
    mean_square_ = MeanSquare(problem_, p_);
  }

  // Takes out diodes whose current no longer shows anywhere on the curve and whose bound allows 0.
  void RemoveFadedDiodes() {
    const double top = *std::max_element(problem_.voltage_V.begin(), problem_.voltage_V.end());
    for (int d = 0; d < DiodeCount(problem_.device); ++d) {
      const int is = SaturationCurrentIndex(d);
      const int n = IdealityIndex(d);
      if (p_[is] <= 0) held_[is] = held_[n] = true;
      if (problem_.lower[is] > 0 || held_[is]) continue;
      const double exponent = top / (p_[n] * problem_.device.module_thermal_voltage_V);
      const double strongest = p_[is] * std::exp(std::min(std::max(exponent, 0.0), 600.0));
      if (strongest > kFaded * problem_.current_scale_A) continue;
      p_[is] = 0;
      held_[is] = held_[n] = true;
    }
  }

  // Gradient and column norms over every parameter that is not fixed and whose diode is there.
  Linearization AtBounds(std::vector<bool>* held) const {
    held->assign(held_.size(), false);
    for (int i = 0; i < size(); ++i) (*held)[i] = problem_.fixed(i);
    for (int d = 0; d < DiodeCount(problem_.device); ++d) {
      const int is = SaturationCurrentIndex(d);
      if (p_[is] <= 0) (*held)[is] = (*held)[IdealityIndex(d)] = true;
    }
    return Linearize(problem_, p_, *held);
  }

  // Signed cosine of each column; 0 where the parameter sits at a bound and would leave it.
  std::vector<double> FreeCosines(const Linearization& now, const std::vector<bool>& held) const {
    const Coordinates coordinates(problem_, p_, held);
    const std::vector<double> theta = coordinates.Start();
    std::vector<double> cosines(theta.size(), 0);
    const double norm = now.residual.norm();
    for (int k = 0; k < coordinates.size(); ++k) {
      const int i = coordinates.parameter(k);
      const double column = now.jacobian.col(k).norm();
      if (!(column > 0) || !(norm > 0)) continue;
      const double cosine = now.jacobian.col(k).dot(now.residual) / (column * norm);
      DCHECK(std::isfinite(cosine));
      if (held_[i]) {
        // Conductance and 1 / n fall as the parameter rises.
        const bool rises = i != kRsh && !Coordinates::IsIdeality(i);
        const bool at_low_end = (p_[i] <= problem_.lower[i]) == rises;
        if (at_low_end ? cosine > 0 : cosine < 0) continue;
      }
      cosines[k] = cosine;
    }
    return cosines;
  }

  double ProjectedGradient() const {
    std::vector<bool> held;
    const Linearization now = AtBounds(&held);
    double largest = 0;
    for (const double cosine : FreeCosines(now, held)) {
      largest = std::max(largest, std::fabs(cosine));
    }
    return largest;
  }

  // Lets the held parameter that most wants back into its range move again.
  bool ReleaseOne() {
    std::vector<bool> held;
    const Linearization now = AtBounds(&held);
    const std::vector<double> cosines = FreeCosines(now, held);
    int best = -1;
    double largest = kFlat;
    for (std::size_t k = 0; k < cosines.size(); ++k) {
      if (!held_[now.parameter[k]] || std::fabs(cosines[k]) <= largest) continue;
      largest = std::fabs(cosines[k]);
      best = now.parameter[k];
    }
    if (best < 0 || ++released_ > 2 * size()) return false;
    held_[best] = false;
    return true;
  }

  // If the residuals correlate with the column of a vanished diode anywhere in the range of its n
  // (looked for on the few points that stand for many), puts the diode there and solves on; keeps
  // it only if that pays.
  bool LetDiodeIn();

  // A trial diode that is far too weak to matter, to read off the direction its current would pull.
  struct Pull {
    double cosine = 0;
    double current = 0;  // the least-squares size of the diode alone
  };
  Pull PullOf(const RefineProblem& problem, int d, double n) const;

  const RefineProblem& problem_;
  const RefineOptions& options_;
  std::vector<double> p_;
  std::vector<bool> held_;
  double mean_square_ = 0;
  bool solver_converged_ = false;
  int iterations_ = 0;
  int released_ = 0;
  int let_in_ = 0;
  StopAsked stop_{options_.stop};
  RefineProblem few_;  // filled where needed
  std::vector<double> best_p_;
  std::vector<bool> best_held_;
  double best_mean_square_ = 0;
};

Polish::Pull Polish::PullOf(const RefineProblem& problem, int d, double n) const {
  const int is = SaturationCurrentIndex(d);
  std::vector<double> trial = p_;
  std::vector<bool> held(held_.size(), true);
  held[is] = false;
  trial[IdealityIndex(d)] = n;
  const double exponent = problem.voltage_scale_V / (n * problem.device.module_thermal_voltage_V);
  trial[is] = 1e-9 * problem.current_scale_A * std::exp(-std::min(exponent, 600.0));
  const Linearization now = Linearize(problem, trial, held);
  const double norm = now.jacobian.col(0).norm();
  const double slope = now.jacobian.col(0).dot(now.residual);
  return {-slope / (norm * now.residual.norm()), trial[is] * -slope / (norm * norm)};
}

bool Polish::LetDiodeIn() {
  if (!options_.let_diodes_in || Ended()) return false;
  constexpr int kSteps = 24;
  for (int d = 0; d < DiodeCount(problem_.device); ++d) {
    const int is = SaturationCurrentIndex(d);
    const int n = IdealityIndex(d);
    if (!vanished(is) || problem_.fixed(is) || let_in_ > 3 * DiodeCount(problem_.device)) continue;
    if (few_.voltage_V.empty()) few_ = Thin(problem_);
    Pull best{kFlat, 0};
    double best_n = 0;
    for (int step = 0; step <= kSteps; ++step) {
      const double t = static_cast<double>(step) / kSteps;
      const double trial = problem_.fixed(n)
                               ? problem_.lower[n]
                               : 1 / ((1 - t) / problem_.lower[n] + t / problem_.upper[n]);
      const Pull pull = PullOf(few_, d, trial);
      if (pull.cosine <= best.cosine) continue;
      best = pull;
      best_n = trial;
    }
    if (best_n > 0 && few_.points.size < problem_.points.size) {
      best = PullOf(problem_, d, best_n);
      if (best.cosine <= kFlat) best_n = 0;
    }
    if (best_n <= 0) continue;
    ++let_in_;
    const std::vector<double> before = p_;
    const std::vector<bool> held_before = held_;
    const double mean_square_before = mean_square_;
    p_[is] = std::min(best.current, problem_.upper[is]);
    p_[n] = best_n;
    held_[is] = false;
    held_[n] = problem_.fixed(n);
    mean_square_ = MeanSquare(problem_, p_);
    Solve(/*bounded=*/true, 1e-9, 40);
    if (mean_square_ < mean_square_before * (1 - 1e-13)) return true;
    p_ = before;
    held_ = held_before;
    mean_square_ = mean_square_before;
  }
  return false;
}

}  // namespace

RefineEnd Refine(const RefineProblem& problem, std::vector<double> start,
                 const RefineOptions& options) {
  return Polish(problem, std::move(start), options).Run();
}

RefineEnd RefineFrom(const RefineProblem& problem, const std::vector<double>& start,
                     const RefineOptions& options) {
  const double tolerance = std::max(options.function_tolerance, 1e-11);
  RefineEnd end = Refine(problem, SeparableDescent(problem, start, tolerance), options);
  if (end.mean_square <= MeanSquare(problem, start) * (1 + kWorse)) return end;
  RefineEnd own = Refine(problem, start, options);
  return own.mean_square < end.mean_square ? own : end;
}

RefineEnd RefinePlainly(const RefineProblem& problem, std::vector<double> start,
                        const RefineOptions& options) {
  return Polish(problem, std::move(start), options).RunPlainly();
}

}  // namespace lyrefit
