#pragma once

#include <cmath>
#include <limits>

#include "lyrefit/base/portable_exp.h"
#include "lyrefit/device/term.h"

namespace lyrefit {

[[gnu::always_inline]] inline double Choose(bool condition, double yes, double no) { return condition ? yes : no; }
[[gnu::always_inline]] inline bool All(bool condition) { return condition; }
[[gnu::always_inline]] inline double Magnitude(double x) { return std::fabs(x); }

// A value and its derivative with respect to the junction voltage, over any T that the terms take.
template <class T>
struct Slope {
  T value;
  T slope;

  Slope() = default;
  explicit Slope(double constant) : value(constant), slope(0.0) {}
  Slope(const T& v, const T& s) : value(v), slope(s) {}

  friend Slope operator+(const Slope& a, const Slope& b) {
    return {a.value + b.value, a.slope + b.slope};
  }
  friend Slope operator-(const Slope& a, const Slope& b) {
    return {a.value - b.value, a.slope - b.slope};
  }
  friend Slope operator-(const Slope& a) { return {-a.value, -a.slope}; }
  friend Slope operator*(const Slope& a, double b) { return {a.value * b, a.slope * b}; }
  friend Slope exp(const Slope& a) {
    using std::exp;
    const T e = exp(a.value);
    return {e, e * a.slope};
  }
  friend Slope Smaller(const Slope& a, const Slope& b) {
    const auto right = b.value < a.value;
    return {Choose(right, b.value, a.value), Choose(right, b.slope, a.slope)};
  }
};

// Voltage-independent part of a device, prepared once per parameter vector. At most kMaxTerms terms.
struct PreparedDevice {
  static constexpr int kMaxTerms = 16;
  PreparedTerm<double> terms[kMaxTerms];
  int count = 0;
  double rs = 0;
  double largest_current = 0;  // Iph + sum of Is: F(Vd) <= this - Vd / Rsh
  double shunt_conductance = 0;
  double steepest = 1e-6;  // largest 1 / (n Ns Vt) of the diodes, in 1/V
};

inline void PrepareDevice(const Term* terms, int count, int rs, double module_thermal_voltage_V,
                          const double* p, PreparedDevice* d) {
  d->count = count;
  d->rs = p[rs];
  for (int t = 0; t < count; ++t) {
    PreparedTerm<double>& term = d->terms[t];
    PrepareTerm(terms[t], p, module_thermal_voltage_V, &term);
    if (term.kind == TermKind::kShunt) {
      d->shunt_conductance += term.a;
    } else {
      d->largest_current += term.a;
    }
    if (term.kind == TermKind::kDiode) {
      d->steepest = Larger(d->steepest, term.b);
    }
  }
}

template <class T>
T PreparedCurrent(const PreparedDevice& d, const T& vd) {
  T current = TermCurrent(d.terms[0], vd);
  for (int t = 1; t < d.count; ++t) current = current + TermCurrent(d.terms[t], vd);
  return current;
}

// No root lies above this for terminal voltages up to `voltage_V`: where a single diode alone would
// already carry more than the whole device can. Exponents stay small below it.
inline double JunctionVoltageLimit(const PreparedDevice& d, double voltage_V) {
  const double reach = voltage_V + d.rs * d.largest_current;  // bound of Rs x diode current, Vd >= 0
  double limit = std::numeric_limits<double>::max();
  if (!(reach > 0)) return limit;
  for (int t = 0; t < d.count; ++t) {
    if (d.terms[t].kind != TermKind::kDiode) continue;
    const double scale = d.rs * d.terms[t].a;
    if (!(scale > 0)) continue;
    const double ratio = reach / scale;
    if (!(ratio < std::numeric_limits<double>::max())) continue;
    limit = Smaller(limit, Larger(LogUpperBound(ratio), 0.0) / d.terms[t].b);
  }
  return limit;
}

// Root of g(Vd) = Vd - V - Rs F(Vd), and the current there. F falls and is concave in Vd, so g rises and
// is convex: from any start one Newton step lands at or right of the root, `limit` keeps it from flying
// off, and from there Newton falls monotonically on the root. Convergence is quadratic with constant
// 1 / (2 n Ns Vt); the last step is small enough for the next to be below rounding.
// The current is read off the flatter of the two curves that cross at the root: F itself, or
// (Vd - V) / Rs.
template <class T>
T SolveCurrentFrom(const PreparedDevice& d, double diode_limit, const T& voltage, const T& start,
                   T* junction_voltage) {
  constexpr int kMaxIterations = 100;
  const double rs = d.rs;
  const T linear_limit =
      (voltage + T(rs * d.largest_current)) * (1.0 / (1.0 + rs * d.shunt_conductance));
  const T raw_limit = Smaller(linear_limit, T(diode_limit));
  const T limit = raw_limit + (Magnitude(raw_limit) + Magnitude(voltage)) * 1e-13;
  const double small_step = 2e-8 / d.steepest;
  T x = Smaller(start, limit);
  T current = x;
  T step = x;
  T slope = x;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Slope<T> f = PreparedCurrent(d, Slope<T>(x, T(1.0)));
    const T next = Smaller(x - (x - voltage - f.value * rs) / (T(1.0) - f.slope * rs), limit);
    step = next - x;
    x = next;
    current = f.value + f.slope * step;
    slope = f.slope;
    if (All(Magnitude(step) < T(small_step) + Magnitude(x) * 1e-15)) break;
  }
  *junction_voltage = x;
  if (!(rs > 0)) return current;
  return Choose(slope * rs < T(-1.0), (x - voltage) * (1.0 / rs), current);
}

}  // namespace lyrefit
