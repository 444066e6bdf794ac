#pragma once

#include <cmath>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The terms of the terminal law
//
//   Vd = V + I Rs                      junction voltage of the whole device, in volt
//   I  = sum of terms(Vd)              delivered current in ampere, generator sign
//
// Each term is a template over the type `S` of the parameters and `T` of the junction voltage. The
// same code serves double, automatic differentiation (a dual number for S, T or both) and eight
// points at a time (T = a kernel's pack). `exp` and `Smaller` are found by the namespace of T.
//
// To add a term: one TermKind, one line in PrepareTerm, in UsualTermCurrent and in UsualBend. A
// finite Vd must not lead to NaN for any parameters inside their bounds.
enum class TermKind {
  kPhotocurrent,  // {Iph}      I = Iph
  kDiode,         // {Is, n}    I = -Is (exp(Vd / (n Ns Vt)) - 1)                    Shockley
  kShunt,         // {Rsh}      I = -Vd / Rsh
  // {Iph, d2mutau, NsVbi}  I = -Iph d2mutau / (NsVbi - Vd): recombination in the i-layer of
  // amorphous silicon and CdTe. d2mutau is in volt, NsVbi is the built-in voltage of all cells.
  // Sources: Merten et al. 1998, doi:10.1109/16.658676; PVsyst; pvlib's bishop88.
  kRecombination,
};

// One term of a device, and the positions of its parameters.
struct Term {
  TermKind kind;
  int parameter[3];  // positions in the device's parameter vector, -1 where unused
};

// Voltage-independent part of a term.
template <class S>
struct PreparedTerm {
  TermKind kind;
  S a;  // photocurrent, saturation current, conductance, or Iph d2mutau
  S b;  // 1 / (n Ns Vt) of a diode, NsVbi of the recombination, else 0
};

// Largest exponent, far outside any real device. With it even the square of a current, or of its
// derivative, is finite.
constexpr double kLargestExponent = 320;
// Smallest values of shunt resistance, n and NsVbi: smaller ones are replaced, so a bound of 0 is
// valid.
constexpr double kSmallestResistance_ohm = 1e-9;
constexpr double kSmallestIdeality = 1e-3;
constexpr double kSmallestBuiltInVoltage_V = 1e-3;
// Within this fraction of NsVbi from its pole, the recombination current is replaced by its
// tangent. It then falls and is concave at every voltage, without a division by 0.
constexpr double kClosestToPole = 1e-3;

// Smaller and larger of two values, for every number type.
template <class T>
[[gnu::always_inline]] inline T Smaller(const T& a, const T& b) {
  return b < a ? b : a;
}
template <class T>
[[gnu::always_inline]] inline T Larger(const T& a, const T& b) {
  return a < b ? b : a;
}

// Computes the voltage-independent part of a term from the device's parameters `p`.
template <class S>
inline void PrepareTerm(const Term& term, const S* p, double module_thermal_voltage_V,
                        PreparedTerm<S>* prepared) {
  const S& first = p[term.parameter[0]];
  prepared->kind = term.kind;
  prepared->b = S(0.0);
  switch (term.kind) {
    case TermKind::kPhotocurrent:
      prepared->a = first;
      break;
    case TermKind::kDiode:
      prepared->a = first;
      prepared->b =
          1.0 / (Larger(p[term.parameter[1]], S(kSmallestIdeality)) * module_thermal_voltage_V);
      break;
    case TermKind::kShunt:
      // Negative resistances stay: a least-squares step may pass there on its way to a bound.
      prepared->a = 1.0 / (first < S(0.0) ? first : Larger(first, S(kSmallestResistance_ohm)));
      break;
    case TermKind::kRecombination:
      prepared->a = first * p[term.parameter[1]];
      prepared->b = Larger(p[term.parameter[2]], S(kSmallestBuiltInVoltage_V));
      break;
  }
}

// Shockley's diode: -Is (exp(Vd / n Vt) - 1). `per_volt`: 1 / (n Vt). No other code evaluates it.
template <class S, class T>
[[gnu::always_inline]] inline T DiodeCurrent(const S& saturation, const S& per_volt, const T& vd) {
  using std::exp;
  return T(saturation) - exp(Smaller(vd * per_volt, T(kLargestExponent))) * saturation;
}

// See TermKind::kRecombination.
template <class S, class T>
[[gnu::always_inline]] inline T RecombinationCurrent(const PreparedTerm<S>& term, const T& vd) {
  const S closest = term.b * kClosestToPole;
  const T below = Smaller(vd, T(term.b - closest));
  const T gap = T(term.b) - below;
  return -(T(term.a) / gap + (vd - below) * (term.a / (closest * closest)));
}

// Any term except recombination, which is rare. Kernels test for it once, outside their loops over
// points.
template <class S, class T>
[[gnu::always_inline]] inline T UsualTermCurrent(const PreparedTerm<S>& term, const T& vd) {
  switch (term.kind) {
    case TermKind::kPhotocurrent:
      return T(term.a);
    case TermKind::kDiode:
      return DiodeCurrent(term.a, term.b, vd);
    case TermKind::kShunt:
      return -(vd * term.a);
    case TermKind::kRecombination:
      break;
  }
  return T(0.0);
}

// d2I/dVd2 over dI/dVd of the same terms at `vd`, in 1/V. Solvers stop where their next error is
// below rounding, which holds only with the right value.
template <class S, class T>
[[gnu::always_inline]] inline T UsualBend(const PreparedTerm<S>& term, const T& /*vd*/) {
  switch (term.kind) {
    case TermKind::kDiode:
      return T(term.b);
    case TermKind::kPhotocurrent:
    case TermKind::kShunt:
    case TermKind::kRecombination:
      break;
  }
  return T(0.0);
}

// The current of any term at junction voltage `vd`, in ampere.
template <class S, class T>
inline T TermCurrent(const PreparedTerm<S>& term, const T& vd) {
  if (__builtin_expect(term.kind == TermKind::kRecombination, 0)) {
    return RecombinationCurrent(term, vd);
  }
  return UsualTermCurrent(term, vd);
}

}  // namespace lyrefit
