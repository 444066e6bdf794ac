#include "lyrefit/certify/interval.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "lyrefit/base/random.h"
#include "repeats.h"

namespace lyrefit {
namespace {

// 335 bits represent every product and sum of two of the doubles below exactly. For other
// operations the error is far smaller than the width of any double interval.
using Truth = boost::multiprecision::cpp_bin_float_100;

bool Holds(const Interval& x, const Truth& value) {
  return Truth(x.lower) <= value && value <= Truth(x.upper);
}

// A random number of magnitude 1e-60 to 1e60, with a long or short mantissa, sometimes zero.
double AnyNumber(RandomStream* random) {
  if (random->Uniform() < 0.03) return 0;
  double x = (random->Uniform() - 0.5) * std::pow(10, 120 * (random->Uniform() - 0.5));
  if (random->Uniform() < 0.3) x = std::ldexp(std::round(16 * random->Uniform()) - 8, -3);
  return x;
}

Interval AnyInterval(RandomStream* random) {
  const double a = AnyNumber(random);
  if (random->Uniform() < 0.5) return Interval(a);
  const double b = random->Uniform() < 0.5 ? AnyNumber(random) : a * (1 + 1e-15);
  return {std::min(a, b), std::max(a, b)};
}

Truth Within(const Interval& x, RandomStream* random) {
  const double t = random->Uniform();
  if (t < 0.3) return x.lower;
  if (t > 0.7) return x.upper;
  return Truth(x.lower) + Truth(t) * (Truth(x.upper) - Truth(x.lower));
}

TEST(Interval, HoldsTheExactResults) {
  SKIP_IF_SANITIZED();
  RandomStream random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    const Interval a = AnyInterval(&random), b = AnyInterval(&random);
    const Truth x = Within(a, &random), y = Within(b, &random);
    ASSERT_TRUE(Holds(a + b, x + y)) << x << " " << y;
    ASSERT_TRUE(Holds(a - b, x - y)) << x << " " << y;
    ASSERT_TRUE(Holds(a * b, x * y)) << x << " " << y;
    if (y != 0) {
      ASSERT_TRUE(Holds(a / b, x / y)) << x << " " << y;
    }
    ASSERT_TRUE(Holds(square(a), x * x)) << x;
    ASSERT_TRUE(Holds(abs(a), abs(x))) << x;
    ASSERT_TRUE(Holds(sqrt(abs(a)), sqrt(abs(x)))) << x;
    ASSERT_TRUE(Holds(max(a, b), std::max(x, y)));
    ASSERT_TRUE(Holds(min(a, b), std::min(x, y)));
  }
}

TEST(Interval, IsNarrow) {
  RandomStream random(2);
  for (int trial = 0; trial < 10000; ++trial) {
    const double a = random.Uniform() + 0.1, b = random.Uniform() + 0.1;
    for (const Interval& x :
         {Interval(a) + b, Interval(a) * b, Interval(a) / b, sqrt(Interval(a))}) {
      EXPECT_LE(x.upper - x.lower, 4.5e-16 * x.upper);
    }
    const Interval e = exp(Interval(40 * (a - b)));
    EXPECT_LE(e.upper - e.lower, 1.4e-15 * e.upper);
  }
}

TEST(Interval, TakesWhatOverflowsOrHasNoValue) {
  const Interval huge(1e300), infinite(kInfinity), around(-1, 1);
  EXPECT_LT((huge * huge).lower, kInfinity);
  EXPECT_EQ((huge * huge).upper, kInfinity);
  EXPECT_LT((-(huge * huge)).lower, -1e308);
  for (const Interval& x : {Interval(0) * infinite, infinite - infinite, Interval(1) / around,
                            Interval(1) / Interval(0), around * infinite, sqrt(around)}) {
    EXPECT_EQ(x.lower, -kInfinity);
    EXPECT_EQ(x.upper, kInfinity);
  }
  const Interval tiny = Interval(1e-200) * 1e-200;
  EXPECT_LE(tiny.lower, 0);
  EXPECT_GT(tiny.upper, 0);
}

TEST(Interval, HoldsTheExponential) {
  SKIP_IF_SANITIZED();
  RandomStream random(3);
  const auto check = [](double x) {
    const Interval e = exp(Interval(x));
    const Truth truth = exp(Truth(x));
    ASSERT_TRUE(Holds(e, truth)) << x;
    if (x > -650 && x < 700) {
      ASSERT_LE(Truth(e.upper - e.lower), truth * 1.4e-15) << x;
    }
  };
  for (int trial = 0; trial < 30000; ++trial) {
    check(1500 * random.Uniform() - 750);
    check(2 * random.Uniform() - 1);
    check(std::ldexp(random.Uniform() - 0.5, -static_cast<int>(random.Index(300))));
  }
  // Near the ends of the reduced argument's range, where the integer k changes.
  for (int k = -930; k <= 1005; ++k) {
    double x = (k + 0.5) * 0.6931471805599453;
    for (int step = 0; step < 4; ++step) {
      check(x);
      x = std::nextafter(x, -kInfinity);
    }
  }
  for (const double x : {0.0, -0.0, 1e-320, 700.0, -650.0, 709.0, 710.0, -745.0, -1e300, 1e300}) {
    check(x);
  }
  EXPECT_EQ(exp(Interval(-kInfinity)).lower, 0);
  EXPECT_EQ(exp(Interval(kInfinity)).upper, kInfinity);
  EXPECT_EQ(exp(Interval::Anything()).lower, 0);
  EXPECT_EQ(exp(Interval::Anything()).upper, kInfinity);
}

// The observed error is well within the proved 2.8 half units in the last place.
TEST(Interval, ExponentialIsBetterThanItsBounds) {
  SKIP_IF_SANITIZED();
  RandomStream random(4);
  Truth worst = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double x = 1300 * random.Uniform() - 640;
    const Interval e = exp(Interval(x));
    const Truth middle = (Truth(e.lower) + Truth(e.upper)) / 2, truth = exp(Truth(x));
    worst = std::max(worst, Truth(abs(middle / truth - 1)));
  }
  EXPECT_LT(static_cast<double>(worst), 2.8 * 0x1p-53);
}

TEST(WideInterval, HoldsTheExactResults) {
  RandomStream random(5);
  const auto holds = [](const WideInterval& x, const Truth& value) {
    return Truth(x.lower) <= value && value <= Truth(x.upper);
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const double a = AnyNumber(&random), b = AnyNumber(&random);
    const WideInterval third = WideInterval(a) / WideInterval(3);
    const Truth x = Truth(a) / 3;
    ASSERT_TRUE(holds(third, x));
    ASSERT_TRUE(holds(third + WideInterval(b), x + Truth(b)));
    ASSERT_TRUE(holds(third * WideInterval(b), x * Truth(b)));
    ASSERT_TRUE(holds(sqrt(abs(third)), sqrt(abs(x))));
    ASSERT_TRUE(Holds(Hull(third), x));
    const double exponent = 1400 * random.Uniform() - 700;
    const WideInterval e = exp(WideInterval(exponent));
    const Truth truth = exp(Truth(exponent));
    ASSERT_TRUE(holds(e, truth)) << exponent;
    ASSERT_LE(Truth(e.upper) - Truth(e.lower), truth * Truth(1e-28)) << exponent;
  }
}

}  // namespace
}  // namespace lyrefit
