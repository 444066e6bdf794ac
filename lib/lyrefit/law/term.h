#pragma once

#include <cmath>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The terms of the terminal law
//
//   Vd = V + I Rs                      junction voltage of the whole device, in volt
//   I  = sum of terms(Vd)              delivered current in ampere, generator sign
//
// Each term is written once as a template: `S` is the type of the parameters, `T` that of the
// junction voltage. The same lines serve double, automatic differentiation (a dual number for S, T
// or both) and eight points at a time (T = a kernel's pack). `exp` and `Smaller` are found beside
// T.
//
// To add a term: one kind, one line in PrepareTerm and one in TermCurrent. A term must not lead
// from a finite Vd to NaN for any parameters inside their bounds.
enum class TermKind {
  kPhotocurrent,  // {Iph}      I = Iph
  kDiode,         // {Is, n}    I = -Is (exp(Vd / (n Ns Vt)) - 1)                    Shockley
  kShunt,         // {Rsh}      I = -Vd / Rsh
  // {Iph, d2mutau, NsVbi}  I = -Iph d2mutau / (NsVbi - Vd): what recombines in the i-layer of
  // amorphous silicon and CdTe, d2mutau in volt, NsVbi the built-in voltage of all cells (Merten et
  // al. 1998, doi:10.1109/16.661229; PVsyst; pvlib's bishop88).
  kRecombination,
};

// One term of a device, and which parameters it takes.
struct Term {
  TermKind kind;
  int parameter[3];  // positions in the device's parameter vector, -1 where unused
};

// What of a term does not depend on the voltage.
template <class S>
struct PreparedTerm {
  TermKind kind;
  S a;  // the current or conductance in front
  S b;  // 1 / (n Ns Vt) of a diode, NsVbi of the recombination
};

// Exponents are cut here, far outside any real device, so that even the square of a current, or of
// its derivative, is finite.
constexpr double kLargestExponent = 320;
// Smallest shunt resistance and n that are told from 0, so that a bound of 0 is legal.
constexpr double kSmallestResistance_ohm = 1e-9;
constexpr double kSmallestIdeality = 1e-3;
constexpr double kSmallestBuiltInVoltage_V = 1e-3;
// Closer to its pole than this part of NsVbi, the recombination goes on along its tangent: falling
// and concave at every voltage, and never a division by 0.
constexpr double kClosestToPole = 1e-3;

// The smaller and the larger of two, for every number type.
template <class T>
[[gnu::always_inline]] inline T Smaller(const T& a, const T& b) {
  return b < a ? b : a;
}
template <class T>
[[gnu::always_inline]] inline T Larger(const T& a, const T& b) {
  return a < b ? b : a;
}

// What of the term is the same at every voltage, from the device's parameters `p`.
template <class S>
inline void PrepareTerm(const Term& term, const S* p, double module_thermal_voltage_V,
                        PreparedTerm<S>* prepared) {
  const S& first = p[term.parameter[0]];
  prepared->kind = term.kind;
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
      // A negative resistance is let through: a least-squares step may pass there on its way to a
      // bound.
      prepared->a = 1.0 / (first < S(0.0) ? first : Larger(first, S(kSmallestResistance_ohm)));
      break;
    case TermKind::kRecombination:
      prepared->a = first * p[term.parameter[1]];
      prepared->b = Larger(p[term.parameter[2]], S(kSmallestBuiltInVoltage_V));
      break;
  }
}

// Shockley's diode, the one place where it stands: -Is (exp(Vd / n Vt) - 1), `per_volt` being 1 /
// (n Vt).
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

// The terms of every device, all but the rare recombination: apart, so that loops over points can
// ask for the rare one once outside.
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

// The current of any term at junction voltage `vd`, in ampere.
template <class S, class T>
inline T TermCurrent(const PreparedTerm<S>& term, const T& vd) {
  if (__builtin_expect(term.kind == TermKind::kRecombination, 0)) {
    return RecombinationCurrent(term, vd);
  }
  return UsualTermCurrent(term, vd);
}

}  // namespace lyrefit
