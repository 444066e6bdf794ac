#pragma once

#include <cmath>
#include <type_traits>

#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// The residual of one reading of an I-V curve, for a least-squares problem of one's own. It is a
// functor as ceres::AutoDiffCostFunction takes it: one residual, one block with all parameters of a
// device. This header needs no header of Ceres.
//
//   #include <ceres/ceres.h>
//   #include "lyrefit/model/diode_residual.h"
//
//   const auto device = lyrefit::MakeDevice(lyrefit::Model::kSingleDiode, {});
//   double p[] = {0.76, 3e-7, 1.5, 0.04, 50};  // Iph, Is1, n1, Rs, Rsh
//   ceres::Problem problem;
//   problem.AddResidualBlock(
//       new ceres::AutoDiffCostFunction<lyrefit::DiodeResidual, 1, 5>(
//           new lyrefit::DiodeResidual(device, lyrefit::Objective::kSolvedCurrent, 0.5, 0.7)),
//       nullptr, p);
//   for (int i = 0; i < 5; ++i) problem.SetParameterLowerBound(p, i, 0);
//
// Equation: the sum F of the device's terms (term.h) behind its series resistance, in ampere,
// generator sign. Which residual is squared (Objective, device.h) is chosen for each reading:
//
//   measured-current  r = weight (F(V + Rs I_measured) - I_measured)
//   solved-current    r = weight (I(V) - I_measured),   I the root of I = F(V + Rs I)
//
// Parameters: those of the device in natural units and in the order of device.h: Iph (A), Is1 (A),
// n1, Rs (ohm), Rsh (ohm), then Is2, n2, Is3, n3; 5, 7 or 9 for one, two or three diodes
// (AddRecombination appends 2). Resistances are of the whole module, n is per cell. The size in
// ceres::AutoDiffCostFunction must be that of the device, which cannot be checked here.
//
// Scale: a saturation current spans decades, and its effect is that of its logarithm. A functor of
// one's own may take log10(Is) or any other unknowns, compute the parameters and call this one;
// lib/lyrefit/model/README.md has such a program. Bounds keep n and Rs positive; the library does
// not look for a good start here, as Fit does.
//
// Derivatives: the terms are evaluated in the number type T. A solved current is found in double by
// the library's own solver. One Newton step from that root, in T, adds the derivatives of the
// implicit function theorem,
//
//   dI = dF / (1 - Rs F'),   dF at fixed I,
//
// so that value and first derivatives are exact to rounding, whatever number of steps the solver
// took. Second derivatives (a T of a T) are not. Source of the method: Griewank and Walther,
// Evaluating Derivatives, 2nd ed., chapter 15, doi:10.1137/1.9780898717761.
//
// T: double, or a type for forward automatic differentiation whose value is its member `a`, with
// arithmetic, `<` and `exp` (ceres::Jet<double, N>, Dual<N>).
class DiodeResidual {
 public:
  // A reading `current_A` (A) at terminal voltage `voltage_V` (V). `weight` multiplies the residual
  // (1/A): 1 / sigma of the current makes it a number of standard deviations; with 1 it is in A.
  // Copies what it needs of `device`, which must have no effects (Device::effects): their readings
  // depend on each other. Fit takes such devices. A device with effects ends the program.
  DiodeResidual(const Device& device, Objective objective, double voltage_V, double current_A,
                double weight = 1);

  // Number of parameters.
  int size() const { return size_; }

  // Writes the residual at parameters `p`, size() of them, to `residual`. False if it is not
  // finite: a reading is not, or a step left the physical range. Ceres then shortens the step.
  template <class T>
  bool operator()(const T* p, T* residual) const {
    const T current = objective_ == Objective::kMeasuredCurrent
                          ? ExplicitCurrent(device_, p, voltage_V_, current_A_)
                          : SolvedCurrent(p);
    *residual = (current - current_A_) * weight_;
    return std::isfinite(Plain(*residual));
  }

  // I(V) at the reading's voltage and parameters `p`, in A, with its first derivatives: the solved
  // current of a residual of one's own. The junction voltage is the solver's, which is more exact
  // than V + Rs I where the two almost cancel.
  template <class T>
  T SolvedCurrent(const T* p) const {
    double values[kMostParameters];
    for (int i = 0; i < size_; ++i) values[i] = Plain(p[i]);
    const Root root = Solve(values);
    if constexpr (std::is_arithmetic_v<T>) {
      return root.current_A;
    } else {
      const int rs = device_.resistance_series;
      const T vd = root.junction_voltage_V + root.current_A * (p[rs] - values[rs]);
      const T f = JunctionCurrent(device_, p, vd);
      return root.current_A + (f - Plain(f)) * root.factor;
    }
  }

  // The residual for ceres::DynamicAutoDiffCostFunction, whose only block has size() parameters.
  template <class T>
  bool operator()(T const* const* blocks, T* residual) const {
    return (*this)(blocks[0], residual);
  }

 private:
  static constexpr int kMostParameters = 11;  // three diodes and recombination

  struct Root {
    double current_A;
    double junction_voltage_V;
    double factor;  // 1 / (1 - Rs F')
  };
  Root Solve(const double* p) const;

  // The value of a number, without derivatives.
  template <class T>
  static double Plain(const T& x) {
    if constexpr (std::is_arithmetic_v<T>) {
      return x;
    } else {
      return Plain(x.a);
    }
  }

  Device device_;  // without descriptions of its parameters
  int size_;
  Objective objective_;
  double voltage_V_;
  double current_A_;
  double weight_;
};

}  // namespace lyrefit
