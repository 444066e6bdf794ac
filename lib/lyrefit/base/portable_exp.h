// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <cstring>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// exp(x) from additions, multiplications and bit shifts only. The result has the same bits on every
// IEEE 754 machine and for every vector width; the last bit of a mathematics library's exp depends
// on the processor. `V` is double or a GCC vector of doubles, `B` the unsigned integer type of the
// same shape. The error is below 1 ulp for x in [-700, 700]. Lower x are set to -700; the caller
// must not pass higher ones.
//
// Method: x = k ln 2 + r with |r| <= ln(2) / 2, by Cody and Waite's two-part ln 2. Then exp(r) = 1
// + r + r^2 q(r), where q is the degree-9 Chebyshev fit (error 2e-17). The factor 2^k is set
// through the exponent bits.
template <class V>
struct ExpParts {
  V power;   // 2^k
  V beyond;  // exp(r) - 1
};
template <class V, class B>
[[gnu::always_inline]] inline ExpParts<V> SplitExp(V x) {
  static_assert(sizeof(V) == sizeof(B), "V and B must have the same shape");
  const V lowest = V{} - 700.0;
  x = x < lowest ? lowest : x;
  constexpr double kMagic = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  const V shifted = x * 0x1.71547652b82fep+0 + kMagic;
  const V k = shifted - kMagic;
  const V r = (x - k * 0x1.62e42fefa0000p-1) - k * 0x1.cf79abc9e3b3ap-40;
  const V r2 = r * r;
  const V r4 = r2 * r2;
  const V q01 = 0x1.0000000000001p-1 + r * 0x1.5555555555556p-3;
  const V q23 = 0x1.5555555553d63p-5 + r * 0x1.11111111109b3p-7;
  const V q45 = 0x1.6c16c1788bd90p-10 + r * 0x1.a01a01a7c41d5p-13;
  const V q67 = 0x1.a019b90d2ae7ap-16 + r * 0x1.71de0dae63bb3p-19;
  const V q89 = 0x1.289185613a3d6p-22 + r * 0x1.af38a9b0ec855p-26;
  const V q = (q01 + r2 * q23) + r4 * ((q45 + r2 * q67) + r4 * q89);
  B bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 1023) << 52;
  ExpParts<V> parts;
  std::memcpy(&parts.power, &bits, sizeof bits);
  parts.beyond = r + r2 * q;
  return parts;
}
template <class V, class B>
[[gnu::always_inline]] inline V PortableExp(V x) {
  const ExpParts<V> parts = SplitExp<V, B>(x);
  return (1.0 + parts.beyond) * parts.power;
}

// exp(x) - 1, error within 3 ulp, also near x = 0.
template <class V, class B>
[[gnu::always_inline]] inline V PortableExpm1(V x) {
  const ExpParts<V> parts = SplitExp<V, B>(x);
  return parts.power * parts.beyond + (parts.power - 1.0);
}

// exp(x) of one number; x above 700 is set to 700.
inline double PortableExp(double x) {
  if (x > 700.0) x = 700.0;
  return PortableExp<double, std::uint64_t>(x);
}

// Decomposition x = mantissa * 2^exponent with a mantissa in [1, 2), for finite x > 0.
template <class V>
struct BinaryParts {
  V exponent;  // an integer
  V mantissa;  // in [1, 2)
};
template <class V, class B>
[[gnu::always_inline]] inline BinaryParts<V> SplitBinary(const V& x) {
  BinaryParts<V> parts;
  B bits;
  std::memcpy(&bits, &x, sizeof bits);
  // Integer to double: the integer becomes the low bits of 2^52, and 2^52 is subtracted below.
  const B exponent = (bits >> 52) | 0x4330000000000000ULL;
  std::memcpy(&parts.exponent, &exponent, sizeof exponent);
  parts.exponent = parts.exponent - (0x1p52 + 1023);
  bits = (bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL;
  std::memcpy(&parts.mantissa, &bits, sizeof bits);
  return parts;
}

// ln(x) for finite x > 0, with the same bits on every machine and the types of PortableExp. The
// starting value, within 0.04, comes from the exponent bits and a straight line. Two Halley steps
// on exp(y) = x follow. The error is below 2 ulp of max(|ln x|, 1).
template <class V, class B>
[[gnu::always_inline]] inline V PortableLog(const V& x) {
  const BinaryParts<V> parts = SplitBinary<V, B>(x);
  V y = (parts.mantissa - 0.96) * 0.6931471805599454;
  for (int step = 0; step < 2; ++step) {
    const V e = PortableExp<V, B>(y);
    y = y + 2.0 * ((parts.mantissa - e) / (parts.mantissa + e));
  }
  return (parts.exponent * 0x1.62e42fefa0000p-1 + y) + parts.exponent * 0x1.cf79abc9e3b3ap-40;
}
inline double PortableLog(double x) { return PortableLog<double, std::uint64_t>(x); }

// An upper bound of ln(x), at most 0.07 above it, for finite x > 0. It uses the exponent bits and
// one tangent, and has the same bits on every machine.
template <class V, class B>
[[gnu::always_inline]] inline V LogUpperBound(const V& x) {
  const BinaryParts<V> parts = SplitBinary<V, B>(x);
  return (parts.exponent + 0.5 + (parts.mantissa - 1.4142135623730951) * 1.0201394465967895) *
         0.6931471805599454;
}
inline double LogUpperBound(double x) { return LogUpperBound<double, std::uint64_t>(x); }

}  // namespace lyrefit
