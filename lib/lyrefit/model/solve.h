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

// F(Vd), the sum of the terms at junction voltage `vd`, in ampere.
template <class T>
T PreparedCurrent(const PreparedDevice& d, const T& vd) {
  T current = TermCurrent(d.terms[0], vd);
  for (int t = 1; t < d.count; ++t) current = current + TermCurrent(d.terms[t], vd);
  return current;
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

// Solves g(Vd) = Vd - V - Rs F(Vd) = 0 at `kCount` voltages and gives the currents there. F falls
// and is concave in Vd, so g rises and is convex. From any start one Newton step lands at or right
// of the root, and from there Newton's method falls monotonically on it. A limit keeps the first
// step finite. Convergence is quadratic with constant 1 / (2 n Ns Vt). Iteration stops when the
// error after the last step is below rounding. All roots step together until the last one
// converges: a step is a long chain of dependent operations, and the processor overlaps several
// chains. The current is read from the flatter of the two curves that cross at the root: F itself,
// or (Vd - V) / Rs. `junction` holds the starts on entry and the junction voltages on return.
template <int kCount, class T>
void SolveTogether(const PreparedDevice& d, double diode_limit, const T* voltage, T* junction,
                   T* current) {
  constexpr int kMaxIterations = 100;
  const double rs = d.rs;
  const double small_step = 2e-8 / d.steepest;
  const double divider = 1.0 / (1.0 + rs * d.shunt_conductance);
  T limit[kCount];
  T slope[kCount];
  for (int k = 0; k < kCount; ++k) {
    const T raw = Smaller((voltage[k] + T(rs * d.largest_current)) * divider, T(diode_limit));
    limit[k] = raw + (Magnitude(raw) + Magnitude(voltage[k])) * 1e-13;
    junction[k] = Smaller(junction[k], limit[k]);
  }
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    T excess = T(-1.0);  // excess of the longest step over rounding
    for (int k = 0; k < kCount; ++k) {
      const T x = junction[k];
      const Dual<1, T> f = PreparedCurrent(d, Dual<1, T>(x, 0));
      const T next = Smaller(x - (x - voltage[k] - f.a * rs) / (T(1.0) - f.v[0] * rs), limit[k]);
      const T step = next - x;
      junction[k] = next;
      current[k] = f.a + f.v[0] * step;
      slope[k] = f.v[0];
      excess = Larger(excess, Magnitude(step) - Magnitude(next) * 1e-15);
    }
    if (All(excess < T(small_step))) break;
  }
  if (!(rs > 0)) return;
  for (int k = 0; k < kCount; ++k) {
    current[k] =
        Choose(slope[k] * rs < T(-1.0), (junction[k] - voltage[k]) * (1.0 / rs), current[k]);
  }
}

}  // namespace lyrefit
