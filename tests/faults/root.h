#pragma once

#include <cmath>

namespace faults {

// Root of a rising function between `low` and `high` to rounding accuracy, by Chandrupatla's
// combination of inverse quadratic interpolation and bisection.
template <class F>
double BracketedRoot(const F& f, double low, double high, double f_low, double f_high) {
  if (f_low == 0) return low;
  if (f_high == 0) return high;
  double a = high, fa = f_high;
  double b = low, fb = f_low;
  double c = a, fc = fa;
  double t = 0.5;
  for (int i = 0; i < 200; ++i) {
    const double x = a + t * (b - a);
    const double fx = f(x);
    if (std::signbit(fx) == std::signbit(fa)) {
      c = a, fc = fa;
    } else {
      c = b, fc = fb;
      b = a, fb = fa;
    }
    a = x, fa = fx;
    const double best = std::fabs(fa) < std::fabs(fb) ? a : b;
    const double width = 2 * 2.2e-16 * std::fabs(best) + 1e-300;
    const double limit = width / std::fabs(b - a);
    if (fx == 0 || limit > 0.5) return best;
    const double xi = (a - b) / (c - b);
    const double phi = (fa - fb) / (fc - fb);
    t = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi) {
      t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    }
    t = std::fmin(1 - limit, std::fmax(limit, t));
  }
  return a;
}

// Root of a rising function without given bounds: the bracket doubles outwards from the guess.
template <class F>
double Root(const F& f, double guess, double stride) {
  double low = guess, high = guess;
  double f_low = f(guess), f_high = f_low;
  for (int i = 0; i < 200 && f_low > 0; ++i, stride *= 2) {
    high = low, f_high = f_low;
    low -= stride;
    f_low = f(low);
  }
  for (int i = 0; i < 200 && f_high < 0; ++i, stride *= 2) {
    low = high, f_low = f_high;
    high += stride;
    f_high = f(high);
  }
  return low == high ? low : BracketedRoot(f, low, high, f_low, f_high);
}

}  // namespace faults
