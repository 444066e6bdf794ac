#pragma once

#include <vector>

#include "lyrefit/device/solve.h"
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
    const Prepared<T> model(problem_.device, p.data());
    const Prepared<double> numbers(problem_.device, value.data());
    for (std::size_t k = 0; k < problem_.voltage_V.size(); ++k) {
      const T current = measured ? model.Explicit(problem_.voltage_V[k], problem_.current_A[k])
                                 : Solved(model, numbers, problem_.voltage_V[k], root[k]);
      residuals[k] = (current - problem_.current_A[k]) * (std::sqrt(problem_.weights[k]) / unit_A_);
      if (!Finite(residuals[k])) return false;
    }
    return true;
  }

 private:
  static double Scalar(double x) { return x; }
  template <class Jet>
  static double Scalar(const Jet& x) {
    return x.a;
  }

  static bool Finite(double x) { return std::isfinite(x); }
  template <class Jet>
  static bool Finite(const Jet& x) {
    return std::isfinite(x.a) && x.v.allFinite();
  }

  // ExplicitCurrent with what does not depend on the point computed once.
  template <class S>
  struct Prepared {
    Prepared(const Device& device, const S* p)
        : rs(p[device.resistance_series]), terms(device.terms.size()) {
      for (std::size_t t = 0; t < terms.size(); ++t) {
        PrepareTerm(device.terms[t], p, device.module_thermal_voltage_V, &terms[t]);
      }
    }
    template <class T>
    T Junction(const T& vd) const {
      T current = T(0.0);
      for (const PreparedTerm<S>& term : terms) current = current + TermCurrent(term, vd);
      return current;
    }
    S Explicit(double voltage_V, double current_A) const {
      return Junction(S(voltage_V + current_A * rs));
    }
    S rs;
    std::vector<PreparedTerm<S>> terms;
  };

  static double Solved(const Prepared<double>& /*model*/, const Prepared<double>& /*numbers*/,
                       double /*voltage_V*/, double root) {
    return root;
  }
  template <class Jet>
  static Jet Solved(const Prepared<Jet>& model, const Prepared<double>& numbers, double voltage_V,
                    double root) {
    Jet current = model.Explicit(voltage_V, root);
    const double vd = voltage_V + root * numbers.rs;
    const double conductance = numbers.Junction(Slope<double>(vd, 1.0)).slope;
    current.a = root;
    current.v *= 1.0 / (1.0 - numbers.rs * conductance);
    return current;
  }

  const RefineProblem& problem_;
  const Coordinates& coordinates_;
  double unit_A_;
};

}  // namespace lyrefit
