#include "lyrefit/certify/interval.h"

#include <cstdint>
#include <cstring>

namespace lyrefit {
namespace {

constexpr double kSmallest = -650;        // exp below it is between 0 and exp(-650)
constexpr double kLargest = 700;          // exp above it is between exp(700) and infinity
constexpr double kExpRounding = 0x1p-51;  // relative error of NearlyExp

// exp(x) for x in [-650, 700]. With x = k ln 2 + r and |r| <= 0.3467 it is
// 2^k (1 + (r + r^2 q(r))), where q is the Taylor series up to r^13 / 13!. Relative errors, in
// units of 2^-53 (the error of one rounding):
//
//   r: x - k ln2_high is exact (ln2_high has 37 bits, k 11; the difference is a multiple of the
//      last place of x and below 1/2). The product with ln2_low is below 2e-9, the error of
//      ln2_high + ln2_low as ln 2 below 1e-23. The difference rounds by 0.35. The total is 0.36,
//      which is also the relative error of exp that results.
//   q: Horner's scheme with coefficients rounded to 1, each step of a value within [0.16, 0.57].
//      The last two steps add 1.6, and earlier errors are scaled by |r| <= 0.35: below 3 of q.
//   r^2 q: 1 for the square, 1 for the product, 3 for q: 5 of 0.069, absolutely 0.35.
//   r + r^2 q: 0.42; 1 + (r + r^2 q): 1.42 where r > 0, 1 where r < 0 (1 at most).
//   Truncation: r^14 / 14! < 5e-18, 0.05.
//
// The total is below 0.36 + (0.35 + 0.42 + 1.42 + 0.05) / 1.41 < 2 for r > 0, and below
// 0.36 + (0.3 + 0.3 + 1 + 0.05) / 0.70 < 2.8 for r < 0. It is taken as 4, which is 2^-51 and covers
// the rounding of ExpDown() and ExpUp(). Fused multiply-add omits some roundings.
double NearlyExp(double x) {
  constexpr double kLn2High = 0x1.62e42fefa0000p-1;
  constexpr double kLn2Low = 0x1.cf79abc9e3b3ap-40;
  const double k = std::floor(x * 0x1.71547652b82fep+0 + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double q = 1.0 / 6227020800.0;
  for (const double factorial : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0,
                                 720.0, 120.0, 24.0, 6.0, 2.0}) {
    q = q * r + 1 / factorial;
  }
  const double near_one = 1 + (r + r * r * q);
  const std::uint64_t bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023) << 52;
  double power;
  std::memcpy(&power, &bits, sizeof power);
  return near_one * power;  // exact
}

// exp(x) for |x| <= 11000: Taylor series of x / 2^m with its remainder, squared m times, all in
// intervals.
WideInterval SlowExp(const WideReal& x) {
  constexpr int kTerms = 24;
  int halvings = 0;
  WideReal size = abs(x);
  while (size > WideReal(0.125)) {
    size = ldexp(size, -1);
    ++halvings;
  }
  const WideInterval r(ldexp(x, -halvings));  // exact
  // The remainder is below 2 |r|^(n+1) / (n+1)!, here 2 / 8^25 / 25! < 2^-157.
  const WideReal remainder = ldexp(WideReal(1), -157);
  WideInterval sum(1);
  for (int n = kTerms; n >= 1; --n) sum = WideInterval(1) + r * sum / WideInterval(n);
  sum += WideInterval(-remainder, remainder);
  for (int i = 0; i < halvings; ++i) sum *= sum;
  return sum;
}

WideReal Clamped(const WideReal& x) {
  const WideReal limit = 11000;
  return x < -limit ? WideReal(-limit) : x > limit ? limit : x;
}

}  // namespace

double ExpDown(double x) {
  if (x < kSmallest) return 0;
  const double e = NearlyExp(std::min(x, kLargest));
  return e - e * kExpRounding;
}

double ExpUp(double x) {
  if (x > kLargest) return kInfinity;
  const double e = NearlyExp(std::max(x, kSmallest));
  return e + e * kExpRounding;
}

WideReal ExpDown(const WideReal& x) { return x < -11000 ? WideReal(0) : SlowExp(Clamped(x)).lower; }

WideReal ExpUp(const WideReal& x) {
  return x > 11000 ? std::numeric_limits<WideReal>::infinity() : SlowExp(Clamped(x)).upper;
}

Interval Hull(const WideInterval& x) {
  return Interval(RoundedDown(static_cast<double>(x.lower)),
                  RoundedUp(static_cast<double>(x.upper)));
}

}  // namespace lyrefit
