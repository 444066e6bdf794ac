#pragma once

#include <vector>

#include "lyrefit/device/current.h"
#include "lyrefit/refine/coordinates.h"

namespace lyrefit {

// Widest dual number of the polish: every model fits, so one pass gives all derivatives.
constexpr int kJetWidth = 10;

// sqrt(weight) x residual of every point in units of `unit_A`, for double or a dual number T. The
// solved current is found in double and its derivatives follow from the implicit function theorem:
// one evaluation of the explicit right-hand side at the root, divided by 1 - Rs F'. Differentiating
// the Newton iteration would cost more and be less exact.
class CurveResiduals {
 public:
  CurveResiduals(const RefineProblem& problem, const Coordinates& coordinates, double unit_A)
      : problem_(problem), coordinates_(coordinates), unit_A_(unit_A) {}

  template <class T>
  bool operator()(T const* const* theta, T* residuals) const {
    if (!coordinates_.Sane(theta[0])) return false;
    std::vector<T> p(problem_.device.parameters.size());
    coordinates_.ToParameters(theta[0], p.data());
    std::vector<double> value(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) value[i] = Scalar(p[i]);
    const bool measured = problem_.objective == Objective::kMeasuredCurrent;
    const std::vector<double> root =
        measured ? problem_.current_A
                 : SolveCurrents(problem_.device, value.data(), problem_.points, *problem_.kernel);
    for (std::size_t k = 0; k < problem_.voltage_V.size(); ++k) {
      const T current = measured ? ExplicitCurrent(problem_.device, p.data(), problem_.voltage_V[k],
                                                   problem_.current_A[k])
                                 : Solved(p.data(), value.data(), problem_.voltage_V[k], root[k]);
      residuals[k] = (current - problem_.current_A[k]) * (std::sqrt(problem_.weights[k]) / unit_A_);
      if (!std::isfinite(Scalar(residuals[k]))) return false;
    }
    return true;
  }

 private:
  static double Scalar(double x) { return x; }
  template <class Jet>
  static double Scalar(const Jet& x) {
    return x.a;
  }

  double Solved(const double* /*p*/, const double* /*value*/, double /*voltage_V*/,
                double root) const {
    return root;
  }
  template <class Jet>
  Jet Solved(const Jet* p, const double* value, double voltage_V, double root) const {
    const OperatingPoint point = KnownOperatingPoint(problem_.device, value, voltage_V, root);
    Jet current = ExplicitCurrent(problem_.device, p, voltage_V, root);
    current.a = root;
    current.v *= ImplicitFactor(problem_.device, value, point);
    return current;
  }

  const RefineProblem& problem_;
  const Coordinates& coordinates_;
  double unit_A_;
};

}  // namespace lyrefit
