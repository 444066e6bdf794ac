// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cmath>
#include <type_traits>

#include "lyrefit/base/public.h"

// Forced inlining: a function call costs more time than the few operations of these functions.
#define LYREFIT_INLINE [[gnu::always_inline]]

namespace LYREFIT_PUBLIC lyrefit {

template <int N, class T>
struct Dual;

// Selects element by element: `yes` where the condition holds, `no` elsewhere. Both are always
// computed, so neither may be NaN or infinite.
LYREFIT_INLINE inline double Choose(bool condition, double yes, double no) {
  return condition ? yes : no;
}
template <class Condition, int N, class T>
LYREFIT_INLINE inline Dual<N, T> Choose(const Condition& condition, const Dual<N, T>& yes,
                                        const Dual<N, T>& no) {
  Dual<N, T> result;
  result.a = Choose(condition, yes.a, no.a);
  for (int k = 0; k < N; ++k) result.v[k] = Choose(condition, yes.v[k], no.v[k]);
  return result;
}

// Forward automatic differentiation: a value and its derivatives with respect to N unknowns. T is
// double or a vector of doubles (model/pack.h and the vectors inside the kernels). The header that
// declares T also supplies its `exp`, `log`, `sqrt` and comparisons. Dual<1, T> carries the
// derivative along one direction.
template <int N, class T = double>
struct Dual {
  T a;     // the value
  T v[N];  // its derivatives

  Dual() = default;  // uninitialised, as for T
  // A constant: all derivatives are 0.
  // NOLINTNEXTLINE(google-explicit-constructor)
  LYREFIT_INLINE Dual(const T& constant) : a(constant) {
    for (T& derivative : v) derivative = T(0.0);
  }
  // A constant of an arithmetic type other than T.
  template <class Number,
            class = std::enable_if_t<std::is_arithmetic_v<Number> && !std::is_same_v<Number, T>>>
  // NOLINTNEXTLINE(google-explicit-constructor)
  LYREFIT_INLINE Dual(Number constant) : Dual(T(static_cast<double>(constant))) {}
  // The unknown number `index`: its derivative with respect to itself is 1, the others are 0.
  LYREFIT_INLINE Dual(const T& value, int index) : Dual(value) { v[index] = T(1.0); }

  // Chain rule for a function f of this dual, with `value` = f(a) and `slope` = f'(a).
  LYREFIT_INLINE Dual Chain(const T& value, const T& slope) const {
    Dual result;
    result.a = value;
    for (int k = 0; k < N; ++k) result.v[k] = slope * v[k];
    return result;
  }

  // Arithmetic on two duals.
  LYREFIT_INLINE friend Dual operator+(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a + y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.v[k] + y.v[k];
    return result;
  }
  LYREFIT_INLINE friend Dual operator-(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a - y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.v[k] - y.v[k];
    return result;
  }
  LYREFIT_INLINE friend Dual operator*(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a * y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.a * y.v[k] + y.a * x.v[k];
    return result;
  }
  LYREFIT_INLINE friend Dual operator/(const Dual& x, const Dual& y) {
    Dual result;
    result.a = x.a / y.a;
    for (int k = 0; k < N; ++k) result.v[k] = x.v[k] - result.a * y.v[k];
    if constexpr (N == 1) {
      result.v[0] = result.v[0] / y.a;
    } else {
      const T inverse = T(1.0) / y.a;
      for (int k = 0; k < N; ++k) result.v[k] = inverse * result.v[k];
    }
    return result;
  }
  LYREFIT_INLINE friend Dual operator-(const Dual& x) {
    Dual result;
    result.a = -x.a;
    for (int k = 0; k < N; ++k) result.v[k] = -x.v[k];
    return result;
  }
  // Arithmetic with a plain number, whose derivatives are 0.
  LYREFIT_INLINE friend Dual operator+(Dual x, double y) {
    x.a = x.a + T(y);
    return x;
  }
  LYREFIT_INLINE friend Dual operator+(double y, Dual x) {
    x.a = x.a + T(y);
    return x;
  }
  LYREFIT_INLINE friend Dual operator-(Dual x, double y) {
    x.a = x.a - T(y);
    return x;
  }
  LYREFIT_INLINE friend Dual operator-(double y, const Dual& x) {
    Dual result = -x;
    result.a = T(y) - x.a;
    return result;
  }
  LYREFIT_INLINE friend Dual operator*(Dual x, double y) {
    x.a = x.a * y;
    for (int k = 0; k < N; ++k) x.v[k] = x.v[k] * y;
    return x;
  }
  LYREFIT_INLINE friend Dual operator*(double y, const Dual& x) { return x * y; }
  LYREFIT_INLINE friend Dual operator/(Dual x, double y) {
    x.a = x.a / T(y);
    for (int k = 0; k < N; ++k) x.v[k] = x.v[k] * (1 / y);
    return x;
  }
  // Arithmetic with a vector of plain numbers, where T is a vector.
  template <class U, class = std::enable_if_t<std::is_same_v<U, T> && !std::is_same_v<T, double>>>
  LYREFIT_INLINE friend Dual operator*(Dual x, const U& y) {
    x.a = x.a * y;
    for (int k = 0; k < N; ++k) x.v[k] = x.v[k] * y;
    return x;
  }
  template <class U, class = std::enable_if_t<std::is_same_v<U, T> && !std::is_same_v<T, double>>>
  LYREFIT_INLINE friend Dual operator*(const U& y, const Dual& x) {
    return x * y;
  }
  template <class U, class = std::enable_if_t<std::is_same_v<U, T> && !std::is_same_v<T, double>>>
  LYREFIT_INLINE friend Dual operator+(Dual x, const U& y) {
    x.a = x.a + y;
    return x;
  }
  template <class U, class = std::enable_if_t<std::is_same_v<U, T> && !std::is_same_v<T, double>>>
  LYREFIT_INLINE friend Dual operator+(const U& y, const Dual& x) {
    return x + y;
  }
  template <class U, class = std::enable_if_t<std::is_same_v<U, T> && !std::is_same_v<T, double>>>
  LYREFIT_INLINE friend Dual operator-(Dual x, const U& y) {
    x.a = x.a - y;
    return x;
  }
  template <class U, class = std::enable_if_t<std::is_same_v<U, T> && !std::is_same_v<T, double>>>
  LYREFIT_INLINE friend Dual operator-(const U& y, const Dual& x) {
    Dual result = -x;
    result.a = y - x.a;
    return result;
  }
  LYREFIT_INLINE friend auto operator<(const Dual& x, const Dual& y) { return x.a < y.a; }

  // Elementary functions. At 0 the derivative of abs(x) is the derivative of x.
  LYREFIT_INLINE friend Dual exp(const Dual& x) {
    using std::exp;
    const T e = exp(x.a);
    return x.Chain(e, e);
  }
  LYREFIT_INLINE friend Dual log(const Dual& x) {
    using std::log;
    return x.Chain(log(x.a), T(1.0) / x.a);
  }
  LYREFIT_INLINE friend Dual sqrt(const Dual& x) {
    using std::sqrt;
    const T root = sqrt(x.a);
    return x.Chain(root, T(0.5) / root);
  }
  LYREFIT_INLINE friend Dual abs(const Dual& x) { return Choose(x.a < T(0.0), -x, x); }
  LYREFIT_INLINE friend Dual Smaller(const Dual& x, const Dual& y) {
    return Choose(y.a < x.a, y, x);
  }
  LYREFIT_INLINE friend Dual Larger(const Dual& x, const Dual& y) {
    return Choose(x.a < y.a, y, x);
  }
};

// The value of a number or dual, without derivatives.
inline double ValueOf(double x) { return x; }
template <int N, class T>
T ValueOf(const Dual<N, T>& x) {
  return x.a;
}

}  // namespace lyrefit
