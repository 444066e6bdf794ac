// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cmath>
#include <limits>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/portable_exp.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/term.h"

namespace LYREFIT_PUBLIC lyrefit {

// Functions of packs, for plain numbers.
[[gnu::always_inline]] inline bool All(bool condition) { return condition; }
[[gnu::always_inline]] inline double Magnitude(double x) { return std::fabs(x); }

// Voltage-independent part of a device, computed once per parameter vector. At most kMaxTerms
// terms.
struct PreparedDevice {
  static constexpr int kMaxTerms = 16;  // of one device
  PreparedTerm<double> terms[kMaxTerms];
  int count = 0;                 // number of valid `terms`
  double rs = 0;                 // Rs, in ohm
  double largest_current = 0;    // Iph + sum of Is: F(Vd) <= this - Vd / Rsh
  double shunt_conductance = 0;  // 1 / Rsh, in siemens
  double steepest = 1e-6;  // largest ratio of curvature and slope of a term, 1/V: 1 / (n Ns Vt)
};

// Fills `d` for parameters `p`; `rs` is the position of Rs in them.
inline void PrepareDevice(const Term* terms, int count, int rs, double module_thermal_voltage_V,
                          const double* p, PreparedDevice* d) {
  d->count = count;
  d->rs = p[rs];
  for (int t = 0; t < count; ++t) {
    PreparedTerm<double>& term = d->terms[t];
    PrepareTerm(terms[t], p, module_thermal_voltage_V, &term);
    if (term.kind == TermKind::kShunt) {
      d->shunt_conductance += term.a;
    } else if (term.kind != TermKind::kRecombination) {
      d->largest_current += term.a;
    } else if (term.a > 0) {
      d->steepest = Larger(d->steepest, 1.0 / (kClosestToPole * term.b));
    }
    if (term.kind == TermKind::kDiode) {
      d->steepest = Larger(d->steepest, term.b);
    }
  }
}

// Junction voltage at which the recombination current alone drops `reach` over Rs: b - Rs a /
// reach, below the pole at b. Near the pole the term is replaced by its tangent, and so is this
// limit.
inline double RecombinationVoltageLimit(const PreparedTerm<double>& term, double rs, double reach) {
  const double closest = term.b * kClosestToPole;
  const double gap = rs * term.a / reach;
  if (!(gap > 0)) return std::numeric_limits<double>::max();
  if (gap >= closest) return Larger(term.b - gap, 0.0);
  return (term.b - closest) + closest * (closest / gap - 1.0);
}

// Upper bound of the root for terminal voltages up to `voltage_V`. Above it a single diode alone,
// or the recombination alone, carries more than the whole device can. It keeps exponents small.
inline double JunctionVoltageLimit(const PreparedDevice& d, double voltage_V) {
  const double reach =
      voltage_V + d.rs * d.largest_current;  // bound of Rs x diode current, Vd >= 0
  double limit = std::numeric_limits<double>::max();
  if (!(reach > 0)) return limit;
  for (int t = 0; t < d.count; ++t) {
    if (d.terms[t].kind == TermKind::kRecombination) {
      limit = Smaller(limit, RecombinationVoltageLimit(d.terms[t], d.rs, reach));
    }
    if (d.terms[t].kind != TermKind::kDiode) continue;
    const double scale = d.rs * d.terms[t].a;
    if (!(scale > 0)) continue;
    const double ratio = reach / scale;
    if (!(ratio < std::numeric_limits<double>::max())) continue;
    limit = Smaller(limit, Larger(LogUpperBound(ratio), 0.0) / d.terms[t].b);
  }
  return limit;
}

// A current and its first two derivatives by the junction voltage.
template <class T>
struct BentCurrent {
  T value;  // A
  T slope;  // first derivative, A/V
  T bend;   // second derivative, A/V^2
};

// F(Vd), the sum of the terms in ampere, at `kCount` junction voltages. Terms are the outer loop:
// each is a long chain of dependent operations, and the processor overlaps those of all voltages.
template <int kCount, class T>
[[gnu::always_inline]] inline void PreparedBent(const PreparedDevice& d, const T* vd,
                                                BentCurrent<T>* f) {
  for (int k = 0; k < kCount; ++k) f[k] = {T(0.0), T(0.0), T(0.0)};
  for (int t = 0; t < d.count; ++t) {
    const PreparedTerm<double> term = d.terms[t];
    const auto add = [&](int k, const Dual<1, T>& part, const T& bend_per_slope) {
      f[k].value = f[k].value + part.a;
      f[k].slope = f[k].slope + part.v[0];
      f[k].bend = f[k].bend + part.v[0] * bend_per_slope;
    };
    if (__builtin_expect(term.kind == TermKind::kRecombination, 0)) {
      const double closest = term.b * kClosestToPole;
      for (int k = 0; k < kCount; ++k) {
        const T gap = T(term.b) - vd[k];
        const T bend = Choose(T(closest) < gap, T(2.0) / Larger(gap, T(closest)), T(0.0));
        add(k, RecombinationCurrent(term, Dual<1, T>(vd[k], 0)), bend);
      }
      continue;
    }
    for (int k = 0; k < kCount; ++k) {
      add(k, UsualTermCurrent(term, Dual<1, T>(vd[k], 0)), UsualBend(term, vd[k]));
    }
  }
}

// Solves g(Vd) = Vd - V - Rs F(Vd) = 0 at `kCount` voltages and gives the currents there, by
// Halley's method. F falls and is concave in Vd, so g rises and is convex. From the left a step is
// at most Newton's, which lands at or right of the root; from the right it is one to two of
// Newton's. A limit keeps the first step finite. Convergence is cubic with constant 1 / (12 (n Ns
// Vt)^2). Iteration stops when the error after the last step is below rounding. All roots step
// together until the last one converges. The current is read from the flatter of the two curves
// that cross at the root: F itself, or (Vd - V) / Rs. `junction` holds the starts on entry and the
// junction voltages on return.
template <int kCount, class T>
void SolveTogether(const PreparedDevice& d, double diode_limit, const T* voltage, T* junction,
                   T* current) {
  constexpr int kMaxIterations = 100;
  const double rs = d.rs;
  const double small_step = 2e-5 / d.steepest;
  const double divider = 1.0 / (1.0 + rs * d.shunt_conductance);
  T limit[kCount];
  BentCurrent<T> f[kCount];
  for (int k = 0; k < kCount; ++k) {
    const T raw = Smaller((voltage[k] + T(rs * d.largest_current)) * divider, T(diode_limit));
    limit[k] = raw + (Magnitude(raw) + Magnitude(voltage[k])) * 1e-13;
    junction[k] = Smaller(junction[k], limit[k]);
  }
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    T excess = T(-1.0);  // excess of the longest step over rounding
    PreparedBent<kCount>(d, junction, f);
    for (int k = 0; k < kCount; ++k) {
      const T x = junction[k];
      const T g = x - voltage[k] - f[k].value * rs;
      const T slope = T(1.0) - f[k].slope * rs;
      const T square = slope * slope;
      const T bend = Smaller(g * f[k].bend * (-0.5 * rs), square * 0.5);
      const T next = Smaller(x - g * slope / (square - bend), limit[k]);
      const T step = next - x;
      junction[k] = next;
      current[k] = f[k].value + (f[k].slope + f[k].bend * step * 0.5) * step;
      excess = Larger(excess, Magnitude(step) - Magnitude(next) * 1e-15);
    }
    if (All(excess < T(small_step))) break;
  }
  if (!(rs > 0)) return;
  for (int k = 0; k < kCount; ++k) {
    current[k] =
        Choose(f[k].slope * rs < T(-1.0), (junction[k] - voltage[k]) * (1.0 / rs), current[k]);
  }
}

}  // namespace lyrefit
