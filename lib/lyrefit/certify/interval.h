#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// Half a unit in the last place of x, or more (Rump, Zimmermann, Boldo and Melquiond 2009). A
// double that was rounded to nearest, moved down and up by this amount, encloses the exact result.
// The constant covers underflow. The rounding mode is not changed, so this holds with fused
// multiply-add, on any compiler, and in WebAssembly.
inline double Outwards(double x) {
  constexpr double kHalfUlp = 0x1.00000000001p-53;
  constexpr double kUnderflow = 1e-290;
  return std::fabs(x) * kHalfUlp + kUnderflow;
}
inline double RoundedDown(double x) {
  return std::fabs(x) < kInfinity ? x - Outwards(x) : std::nextafter(x, -kInfinity);
}
inline double RoundedUp(double x) {
  return std::fabs(x) < kInfinity ? x + Outwards(x) : std::nextafter(x, kInfinity);
}

// Lower and upper bounds of exp(x); interval.cc has the error analysis.
double ExpDown(double x);
double ExpUp(double x);

// A real number of 113 bits, for the few sums in which nearly everything cancels.
using WideReal = boost::multiprecision::cpp_bin_float_quad;
inline WideReal Outwards(const WideReal& x) {
  static const WideReal kUlp = ldexp(WideReal(1), -111);
  static const WideReal kUnderflow = ldexp(WideReal(1), -16000);
  return abs(x) * kUlp + kUnderflow;
}
inline WideReal RoundedDown(const WideReal& x) { return x - Outwards(x); }
inline WideReal RoundedUp(const WideReal& x) { return x + Outwards(x); }
WideReal ExpDown(const WideReal& x);
WideReal ExpUp(const WideReal& x);

// An interval that contains the exact result of a computation on exact numbers. (Boost.Interval is
// not used: its intervals convert from any type, which makes every operator of Eigen ambiguous.)
template <class T>
struct IntervalOf {
  T lower, upper;

  // A number converts to an interval implicitly.
  // NOLINTNEXTLINE(google-explicit-constructor)
  IntervalOf(const T& value = T(0)) : lower(value), upper(value) {}
  IntervalOf(const T& least, const T& most) : lower(least), upper(most) {}

  static IntervalOf Anything() {
    return {-std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity()};
  }
  // From ends that were rounded to nearest; NaN gives Anything().
  static IntervalOf Rounded(const T& least, const T& most) {
    if (!(least <= most)) return Anything();
    return {RoundedDown(least), RoundedUp(most)};
  }

  friend IntervalOf operator-(const IntervalOf& a) { return {-a.upper, -a.lower}; }
  friend IntervalOf operator+(const IntervalOf& a, const IntervalOf& b) {
    return Rounded(a.lower + b.lower, a.upper + b.upper);
  }
  friend IntervalOf operator-(const IntervalOf& a, const IntervalOf& b) {
    return Rounded(a.lower - b.upper, a.upper - b.lower);
  }
  friend IntervalOf operator*(const IntervalOf& a, const IntervalOf& b) {
    if (b.lower >= 0) {
      return Rounded(a.lower * (a.lower >= 0 ? b.lower : b.upper),
                     a.upper * (a.upper >= 0 ? b.upper : b.lower));
    }
    if (b.upper <= 0) return -(a * -b);
    const T across0 = a.lower * b.upper, across1 = a.upper * b.lower;
    const T along0 = a.lower * b.lower, along1 = a.upper * b.upper;
    // If a product is infinite or NaN, this sum is NaN, which does not equal anything.
    const T zero = across0 * 0 + across1 * 0 + along0 * 0 + along1 * 0;
    if (!(zero == 0)) return Anything();
    return Rounded(std::min(std::min(across0, across1), std::min(along0, along1)),
                   std::max(std::max(across0, across1), std::max(along0, along1)));
  }
  friend IntervalOf operator/(const IntervalOf& a, const IntervalOf& b) {
    if (b.upper < 0) return -(a / -b);
    if (!(b.lower > 0)) return Anything();
    return Rounded(a.lower / (a.lower >= 0 ? b.upper : b.lower),
                   a.upper / (a.upper >= 0 ? b.lower : b.upper));
  }
  IntervalOf& operator+=(const IntervalOf& b) { return *this = *this + b; }
  IntervalOf& operator-=(const IntervalOf& b) { return *this = *this - b; }
  IntervalOf& operator*=(const IntervalOf& b) { return *this = *this * b; }
  // Needed by Eigen, which tests whether a factor is exactly 0 or 1.
  friend bool operator==(const IntervalOf& a, const IntervalOf& b) {
    return a.lower == b.lower && a.upper == b.upper;
  }
  friend bool operator!=(const IntervalOf& a, const IntervalOf& b) { return !(a == b); }

  friend IntervalOf min(const IntervalOf& a, const IntervalOf& b) {
    return {std::min(a.lower, b.lower), std::min(a.upper, b.upper)};
  }
  friend IntervalOf max(const IntervalOf& a, const IntervalOf& b) {
    return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
  }
  friend IntervalOf abs(const IntervalOf& a) {
    if (a.lower >= 0) return a;
    if (a.upper <= 0) return -a;
    return {T(0), std::max(T(-a.lower), a.upper)};
  }
  friend IntervalOf square(const IntervalOf& a) {
    const IntervalOf size = abs(a);
    return size * size;
  }
  // IEEE 754 requires the square root to be correctly rounded to nearest.
  friend IntervalOf sqrt(const IntervalOf& a) {
    using std::sqrt;
    if (!(a.lower >= 0)) return Anything();
    const IntervalOf root = Rounded(sqrt(a.lower), sqrt(a.upper));
    return {std::max(root.lower, T(0)), root.upper};
  }
  friend IntervalOf exp(const IntervalOf& a) { return {ExpDown(a.lower), ExpUp(a.upper)}; }
};

using Interval = IntervalOf<double>;
using WideInterval = IntervalOf<WideReal>;

Interval Hull(const WideInterval& x);

// Certain upper and lower bounds of a number, for templates over double (rounding ignored) and
// Interval.
inline double Upper(double x) { return x; }
inline double Lower(double x) { return x; }
inline double Upper(const Interval& x) { return x.upper; }
inline double Lower(const Interval& x) { return x.lower; }

// exp(x) - 1.
inline double ExpMinus1(double x) { return std::expm1(x); }
inline Interval ExpMinus1(const Interval& x) { return exp(x) - 1.0; }

template <class Real>
using ArrayOf = Eigen::Array<Real, Eigen::Dynamic, 1>;

}  // namespace lyrefit

namespace Eigen {

template <class T>
struct NumTraits<lyrefit::IntervalOf<T>> : GenericNumTraits<lyrefit::IntervalOf<T>> {
  using Real = lyrefit::IntervalOf<T>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 8,
    MulCost = 16
  };
};

}  // namespace Eigen
