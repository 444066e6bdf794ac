#pragma once

#include <cmath>

namespace lyrefit {

// A value and its derivatives with respect to N unknowns: forward automatic differentiation for
// rooms that know no solver.
template <int N>
struct Dual {
  double a = 0;
  double v[N] = {};

  Dual() = default;
  Dual(double constant) : a(constant) {}  // NOLINT: numbers are duals without derivative
  // The unknown at position `index`.
  Dual(double value, int index) : a(value) { v[index] = 1; }

  // f(this) with f' = slope.
  Dual Chain(double value, double slope) const {
    Dual result;
    result.a = value;
    for (int k = 0; k < N; ++k) result.v[k] = slope * v[k];
    return result;
  }

  friend Dual operator+(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a + y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.v[k] + y.v[k];
    return result;
  }
  friend Dual operator-(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a - y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.v[k] - y.v[k];
    return result;
  }
  friend Dual operator*(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a * y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.a * y.v[k] + y.a * x.v[k];
    return result;
  }
  friend Dual operator/(const Dual& x, const Dual& y) {
    Dual result;
    const double inverse = 1.0 / y.a;
    result.a = x.a * inverse;
    for (int k = 0; k < N; ++k) result.v[k] = inverse * (x.v[k] - result.a * y.v[k]);
    return result;
  }
  friend Dual operator-(const Dual& x) { return x.Chain(-x.a, -1); }
  friend Dual operator+(const Dual& x, double y) { return x.Chain(x.a + y, 1); }
  friend Dual operator+(double y, const Dual& x) { return x.Chain(x.a + y, 1); }
  friend Dual operator-(const Dual& x, double y) { return x.Chain(x.a - y, 1); }
  friend Dual operator-(double y, const Dual& x) { return x.Chain(y - x.a, -1); }
  friend Dual operator*(const Dual& x, double y) { return x.Chain(x.a * y, y); }
  friend Dual operator*(double y, const Dual& x) { return x.Chain(x.a * y, y); }
  friend Dual operator/(const Dual& x, double y) { return x.Chain(x.a / y, 1 / y); }
  friend bool operator<(const Dual& x, const Dual& y) { return x.a < y.a; }

  friend Dual exp(const Dual& x) {
    const double e = std::exp(x.a);
    return x.Chain(e, e);
  }
  friend Dual log(const Dual& x) { return x.Chain(std::log(x.a), 1 / x.a); }
  friend Dual sqrt(const Dual& x) {
    const double root = std::sqrt(x.a);
    return x.Chain(root, 0.5 / root);
  }
  friend Dual abs(const Dual& x) { return x.a < 0 ? -x : x; }
};

inline double ValueOf(double x) { return x; }
template <int N>
double ValueOf(const Dual<N>& x) {
  return x.a;
}

}  // namespace lyrefit
