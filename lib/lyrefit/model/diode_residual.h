#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// The root of the implicit equation at one voltage, in double precision.
struct SolvedPoint {
  double current_A;    // I with I = F(V + I Rs), to about 1e-15 of |I| + Iph
  double explicit_A;   // F(V + I Rs) at that current, as it is computed
  double denominator;  // 1 - Rs dF/dVd, at least 1 for a passive device
};

// Solves the implicit equation of a device without effects at terminal voltage `voltage_V` (V) and
// parameters `p` (device.size() of them). Never fails for finite parameters.
SolvedPoint SolvePoint(const Device& device, const double* p, double voltage_V);

// The value of a number of automatic differentiation: `a` of a ceres::Jet.
inline double JetValue(double number) { return number; }
template <class Jet>
auto JetValue(const Jet& number) -> decltype(number.a) {
  return number.a;
}

// The residual of one measured point under the implicit diode equation, as a functor for least
// squares with automatic differentiation. The equation is
//
//   I = F(V + I Rs)
//   F(Vd) = Iph - sum of Is (exp(Vd / (n Ns Vt)) - 1) - Vd / Rsh
//
// Ceres takes it as ceres::AutoDiffCostFunction<DiodeResidual, 1, 5> for a single diode, with 7 and 9
// parameters for two and three. This header includes nothing of Ceres: any number type with
// arithmetic, comparisons and exp() found by its namespace will do, whose value is the member `a`.
//
// The parameters are those of the device, in its order and natural units: Iph (A), Is1 (A), n1 (per
// cell), Rs (ohm), Rsh (ohm), Is2 (A), n2, Is3 (A), n3. Is spans decades and varies with n: a solver
// does better with its logarithm, which a functor of one's own makes and passes on
// (lib/lyrefit/estimate/README.md has such a program).
//
// Both residuals are model minus measurement, in ampere times `weight`. That of the measured current
// is F(V + I Rs) - I at the measured I: it is explicit. That of the solved current is I(V) - I at the
// root I(V), found in double precision. Its derivatives are those of the implicit function theorem,
// dI = dF / (1 - Rs dF/dVd), where dF is the derivative by the parameters at the root and fixed I. To
// differentiate the iterations of a solver would cost more and be less exact. The two sums of squares
// have different optima and must not be compared (see Objective).
class DiodeResidual {
 public:
  // A point at `voltage_V` (V) with the measured current `current_A` (A, generator sign). `weight`
  // (1/A) is 1 over the standard deviation of the current, or 1 for a residual in ampere. `device`
  // is copied without its names; it must have no effects, which need a whole measurement.
  DiodeResidual(const Device& device, Objective objective, double voltage_V, double current_A,
                double weight = 1);

  // `residual[0]` at the parameters `p` (device.size() of them). Always true: every finite vector
  // has a residual; parameters below their smallest useful value count as that (term.h).
  template <class T>
  bool operator()(const T* p, T* residual) const {
    if (objective_ == Objective::kMeasuredCurrent) {
      residual[0] = (ExplicitCurrent(device_, p, voltage_V_, current_A_) - current_A_) * weight_;
      return true;
    }
    double values[kMost];
    for (int k = 0; k < size_; ++k) values[k] = JetValue(p[k]);
    const SolvedPoint at = SolvePoint(device_, values, voltage_V_);
    const T step = ExplicitCurrent(device_, p, voltage_V_, at.current_A) - at.explicit_A;
    residual[0] = (step / at.denominator + (at.current_A - current_A_)) * weight_;
    return true;
  }

 private:
  static constexpr int kMost = 12;  // parameters: three diodes and the recombination

  Device device_;
  int size_;
  Objective objective_;
  double voltage_V_;
  double current_A_;
  double weight_;
};

}  // namespace lyrefit
