#pragma once

#include <cmath>
#include <vector>

#include "lyrefit/refine/joint.h"

namespace lyrefit {

// What the solver sees instead of the shared parameters, scaled so that no coordinate depends
// strongly on another:
//   photocurrent          Iph / I0
//   saturation currents   ln(Is / I0) + V0 / (n Ns Vt): the diode's current near open circuit
//   n, n2                 1 / n
//   Rs                    Rs / R0
//   Rsh                   R0 / Rsh, so that a perfect shunt is 0
//   Rsh0                  Rsh / Rsh0, between exp(-Rexp) and 1
//   the rest              linear, in steps of natural size
class JointCoordinates {
 public:
  JointCoordinates(const JointProblem& problem, std::vector<double> shared, std::vector<bool> held)
      : problem_(&problem), shared_(std::move(shared)), held_(std::move(held)) {
    for (int i = 0; i < problem.shared(); ++i) {
      if (!held_[i]) moving_.push_back(i);
    }
  }

  int size() const { return static_cast<int>(moving_.size()); }
  int parameter(int coordinate) const { return moving_[coordinate]; }

  std::vector<double> Start() const {
    std::vector<double> theta;
    for (const int i : moving_) theta.push_back(Forward(i, shared_[i]));
    return theta;
  }

  // Shared parameters of a point; T may be a dual number.
  template <class T>
  void ToShared(const T* theta, T* shared) const {
    using std::exp;
    const Translation& at = problem_->translation;
    for (int i = 0; i < problem_->shared(); ++i) shared[i] = T(shared_[i]);
    for (int k = 0; k < size(); ++k) {
      const int i = moving_[k];
      if (i == at.n || i == at.n_2) {
        shared[i] = 1.0 / theta[k];
      } else if (i == at.resistance_shunt) {
        // A free solve may step through 0 to be sent back to the bound; the slope stays right.
        const bool zero = theta[k] < T(kSmallest) && T(-kSmallest) < theta[k];
        shared[i] = ResistanceScale() / (theta[k] + (zero ? 2 * kSmallest : 0.0));
      } else if (!IsSaturation(i) && i != at.resistance_shunt_dark) {
        shared[i] = theta[k] * Step(i);
      }
    }
    for (int k = 0; k < size(); ++k) {  // what depends on the others
      const int i = moving_[k];
      if (IsSaturation(i)) {
        shared[i] = problem_->current_scale_A * exp(theta[k] - Pivot() / shared[IdealityOf(i)]);
      } else if (i == at.resistance_shunt_dark) {
        shared[i] = shared[at.resistance_shunt] / theta[k];
      }
    }
    // A dark shunt that sits at an end of its range is held in proportion to the other.
    const int dark = at.resistance_shunt_dark;
    if (dark >= 0 && held_[dark] && problem_->lower[dark] < problem_->upper[dark]) {
      shared[dark] = shared[at.resistance_shunt] * (shared_[dark] / shared_[at.resistance_shunt]);
    }
  }

  double Forward(int i, double value) const {
    const Translation& at = problem_->translation;
    if (i == at.n || i == at.n_2) return 1 / value;
    if (i == at.resistance_shunt) return ResistanceScale() / value;
    if (i == at.resistance_shunt_dark) return shared_[at.resistance_shunt] / value;
    if (IsSaturation(i)) {
      return std::log(value / problem_->current_scale_A) + Pivot() / shared_[IdealityOf(i)];
    }
    return value / Step(i);
  }

  void Bounds(int coordinate, double* lower, double* upper) const {
    const Translation& at = problem_->translation;
    const int i = moving_[coordinate];
    *lower = -HUGE_VAL;
    *upper = HUGE_VAL;
    if (i == at.saturation_current) return;
    if (i == at.saturation_current_2) {
      *lower = kFaded;
    } else if (i == at.resistance_shunt_dark) {
      *lower = std::exp(-shared_[at.shunt_exponent]);
      *upper = 1;
    } else if (i == at.resistance_shunt) {
      *lower = std::isinf(problem_->upper[i]) ? 0 : ResistanceScale() / problem_->upper[i];
      if (problem_->lower[i] > 0) *upper = ResistanceScale() / problem_->lower[i];
    } else {
      *lower = Forward(i, problem_->lower[i]);
      *upper = Forward(i, problem_->upper[i]);
      if (*lower > *upper) std::swap(*lower, *upper);
    }
  }

  // Whether a point is near enough to its bounds to be worth evaluating.
  template <class T>
  bool Sane(const T* theta) const {
    for (int k = 0; k < size(); ++k) {
      double lower, upper;
      Bounds(k, &lower, &upper);
      const double margin = std::isfinite(upper - lower) ? 0.25 * (upper - lower) : 1;
      const int i = moving_[k];
      if (i == problem_->translation.resistance_shunt && theta[k] < T(-0.1)) return false;
      if (i == problem_->translation.resistance_shunt_dark && theta[k] < T(0.5 * lower)) {
        return false;
      }
      if (IsIdeality(i) && theta[k] < T(0.5 * lower)) return false;
      if (theta[k] < T(lower - margin) || T(upper + margin) < theta[k]) return false;
      if (IsSaturation(i) && T(kLargestLogCurrent) < theta[k]) return false;
    }
    return true;
  }

  bool IsSaturation(int i) const {
    const Translation& at = problem_->translation;
    return i >= 0 && (i == at.saturation_current || i == at.saturation_current_2);
  }
  bool IsIdeality(int i) const {
    const Translation& at = problem_->translation;
    return i == at.n || i == at.n_2;
  }
  int IdealityOf(int saturation) const {
    const Translation& at = problem_->translation;
    return saturation == at.saturation_current ? at.n : at.n_2;
  }

  static constexpr double kFaded = -25;  // ln(current of diode 2 at V0 / I0) that counts as absent

 private:
  static constexpr double kSmallest = 1e-30;
  static constexpr double kLargestLogCurrent = 30;

  double ResistanceScale() const { return problem_->voltage_scale_V / problem_->current_scale_A; }

  double Pivot() const {
    return problem_->voltage_scale_V / problem_->translation.device.module_thermal_voltage_V;
  }

  // The natural value of a step of 1 along a linear coordinate.
  double Step(int i) const {
    const Translation& at = problem_->translation;
    if (i == at.photocurrent) return problem_->current_scale_A;
    if (i == at.resistance_series) return ResistanceScale();
    if (i == at.alpha_sc) return 0.01 * problem_->current_scale_A;
    if (i == at.n_slope || i == at.bandgap_slope) return 0.01;
    if (i == at.built_in_voltage) return problem_->voltage_scale_V;
    if (i == problem_->irradiance_offset()) return 100;
    if (i == problem_->temperature_offset()) return 10;
    return 1;
  }

  const JointProblem* problem_;
  std::vector<double> shared_;
  std::vector<bool> held_;
  std::vector<int> moving_;
};

}  // namespace lyrefit
