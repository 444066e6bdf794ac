#pragma once

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace lyrefit {

// Root of a continuous, finite function between `a` and `b`, to the last bit, by
// doi:10.1145/210089.210111. Without a change of sign: the end whose value is nearer to 0.
template <class F>
double RootBetween(const F& f, double a, double b) {
  if (b < a) std::swap(a, b);
  const double at_a = f(a), at_b = f(b);
  if (!((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0))) {
    return std::fabs(at_b) < std::fabs(at_a) ? b : a;
  }
  constexpr int kDigits = std::numeric_limits<double>::digits;
  std::uintmax_t most = 200;
  const auto [low, high] = boost::math::tools::toms748_solve(
      f, a, b, at_a, at_b, boost::math::tools::eps_tolerance<double>(kDigits), most);
  return 0.5 * (low + high);
}

// Bisects between `inside`, where a predicate holds, and `outside`, until no number lies between.
// (Boost's bisection wants its ends in order, and throws.)
template <class Predicate>
std::pair<double, double> Bisected(const Predicate& holds, double inside, double outside) {
  for (;;) {
    const double middle = 0.5 * (inside + outside);
    if (middle == inside || middle == outside || std::isnan(middle)) return {inside, outside};
    (holds(middle) ? inside : outside) = middle;
  }
}

// The last number before `outside` where the predicate holds.
template <class Predicate>
double LastWhere(const Predicate& holds, double inside, double outside) {
  return Bisected(holds, inside, outside).first;
}

// Where a function between `a` and `b` changes its sign, by its sign alone: its values may be
// infinite. About `b` if it does not.
template <class F>
double SignChange(const F& f, double a, double b) {
  const bool positive = f(a) > 0;
  const auto ends = Bisected([&](double x) { return (f(x) > 0) == positive; }, a, b);
  return 0.5 * (ends.first + ends.second);
}

// Where a function is largest between `a` and a larger `b`, to half the digits, by Brent's method.
template <class F>
double MaximumBetween(const F& f, double a, double b) {
  constexpr int kHalfOfDigits = std::numeric_limits<double>::digits / 2;
  return boost::math::tools::brent_find_minima([&](double x) { return -f(x); }, a, b, kHalfOfDigits)
      .first;
}

}  // namespace lyrefit
