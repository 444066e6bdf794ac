#pragma once

#include <cmath>
#include <vector>

#include "lyrefit/refine/problem.h"

namespace lyrefit {

// The coordinates in which a polish moves. Each is scaled to the curve, and the almost perfect
// correlation of Is and n is taken out:
//   Iph   Iph / I0                       Rs    Rs / R0               I0, V0: largest |I|, |V|
//   Rsh   R0 / Rsh, a conductance        n     1 / n                 R0 = V0 / I0
//   Is    ln(Is / I0) + V0 / (n Ns Vt), the logarithm of the diode's current at V0; if its n is
//   held,
//         that is ln(Is / I0) but for a constant
// A held parameter keeps its value. Every parameter's bound is a bound of its own coordinate,
// except that of Is while its n moves too.
class Coordinates {
 public:
  Coordinates(const RefineProblem& problem, std::vector<double> p, std::vector<bool> held)
      : problem_(&problem), p_(std::move(p)), held_(std::move(held)) {
    for (int i = 0; i < static_cast<int>(held_.size()); ++i) {
      if (!held_[i]) moving_.push_back(i);
    }
  }

  int size() const { return static_cast<int>(moving_.size()); }
  int parameter(int coordinate) const { return moving_[coordinate]; }

  // Coordinates of the current parameters.
  std::vector<double> Start() const {
    std::vector<double> theta;
    for (const int i : moving_) theta.push_back(Forward(i, p_[i]));
    return theta;
  }

  // Parameters of a point; T may be a dual number.
  template <class T>
  void ToParameters(const T* theta, T* p) const {
    using std::exp;
    const int count = static_cast<int>(p_.size());
    for (int i = 0; i < count; ++i) p[i] = T(p_[i]);
    for (int k = 0; k < size(); ++k) {
      const int i = moving_[k];
      if (i == kIph) p[i] = theta[k] * problem_->current_scale_A;
      if (i == kRs) p[i] = theta[k] * problem_->resistance_scale();
      if (i == kRsh) {
        const bool zero = theta[k] < T(kSmallest) && T(-kSmallest) < theta[k];
        p[i] = problem_->resistance_scale() / (zero ? T(kSmallest) : theta[k]);
      }
      if (IsIdeality(i)) p[i] = 1.0 / theta[k];
    }
    for (int k = 0; k < size(); ++k) {
      const int i = moving_[k];
      if (IsSaturation(i)) {
        p[i] = problem_->current_scale_A * exp(theta[k] - Pivot() / p[i + 1]);
      }
    }
  }

  // The coordinate of parameter i at value `value`, the other parameters as they are.
  double Forward(int i, double value) const {
    if (i == kIph) return value / problem_->current_scale_A;
    if (i == kRs) return value / problem_->resistance_scale();
    if (i == kRsh) return problem_->resistance_scale() / value;
    if (IsIdeality(i)) return 1 / value;
    return std::log(value / problem_->current_scale_A) + Pivot() / p_[i + 1];
  }

  // Bounds of a coordinate, or +-infinity where it has none of its own.
  void Bounds(int coordinate, double* lower, double* upper) const {
    const int i = moving_[coordinate];
    *lower = -HUGE_VAL;
    *upper = HUGE_VAL;
    if (IsSaturation(i) && !held_[i + 1]) return;
    if (!(IsSaturation(i) && problem_->lower[i] <= 0)) *lower = Forward(i, problem_->lower[i]);
    *upper = Forward(i, problem_->upper[i]);
    if (i == kRsh && problem_->lower[i] <= 0) *lower = HUGE_VAL;  // Rsh >= 0: any conductance
    if (*lower > *upper) std::swap(*lower, *upper);
  }

  // Whether a point is near enough to the box to be worth evaluating. A free solve may step over a
  // bound (its parameter is then held there), but not into regions where currents overflow.
  template <class T>
  bool Sane(const T* theta) const {
    for (int k = 0; k < size(); ++k) {
      double lower, upper;
      Bounds(k, &lower, &upper);
      if (std::isfinite(lower) && std::isfinite(upper)) {
        const double margin = 0.5 * (upper - lower);
        if (theta[k] < lower - margin || theta[k] > upper + margin) return false;
      }
      if (moving_[k] == kRsh && theta[k] < kLowestConductance) return false;
      if (IsIdeality(moving_[k]) && theta[k] < 0.5 * lower) return false;
      if (IsSaturation(moving_[k]) && !(theta[k] < kLargestLogCurrent)) return false;
    }
    return true;
  }

  static bool IsSaturation(int i) { return i == 1 || (i >= 5 && i % 2 == 1); }
  static bool IsIdeality(int i) { return i == 2 || (i >= 6 && i % 2 == 0); }

 private:
  static constexpr double kSmallest = 1e-30;          // conductance told from 0
  static constexpr double kLowestConductance = -0.1;  // in units of 1 / R0
  static constexpr double kLargestLogCurrent = 30;    // of a diode at V0, in units of I0

  double Pivot() const {
    return problem_->voltage_scale_V / problem_->device.module_thermal_voltage_V;
  }

  const RefineProblem* problem_;
  std::vector<double> p_;
  std::vector<bool> held_;
  std::vector<int> moving_;
};

}  // namespace lyrefit
