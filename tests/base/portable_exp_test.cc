#include "lyrefit/base/portable_exp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

TEST(PortableExp, IsWithinOneUlpOfTheLongDoubleExponential) {
  RandomStream random(1);
  for (int k = 0; k < 1000000; ++k) {
    const double x = -700 + 1400 * random.Uniform();
    const long double exact = std::exp(static_cast<long double>(x));
    const double error = static_cast<double>((PortableExp(x) - exact) / exact);
    ASSERT_LE(std::fabs(error), 0x1p-52) << x;
  }
}

TEST(PortableExp, IsExactAtZeroAndCutOutsideItsRange) {
  EXPECT_EQ(PortableExp(0.0), 1.0);
  EXPECT_EQ(PortableExp(-1e9), PortableExp(-700.0));
  EXPECT_EQ(PortableExp(1e9), PortableExp(700.0));
}

TEST(PortableExp, HasTheseBits) {
  EXPECT_EQ(PortableExp(1.0), 0x1.5bf0a8b14576ap+1);
  EXPECT_EQ(PortableExp(-20.25), 0x1.b93de1e27ca3bp-30);
  EXPECT_EQ(PortableExp(33.3), 0x1.078401f5a3ec8p+48);
}

TEST(PortableExpm1, IsWithinThreeUlpAlsoCloseToZero) {
  RandomStream random(4);
  for (int k = 0; k < 1000000; ++k) {
    const double size = std::pow(10.0, -300 + 302.5 * random.Uniform());
    const double x = random.Uniform() < 0.5 ? -size : size;
    const long double exact = std::expm1(static_cast<long double>(x));
    const double found = PortableExpm1<double, std::uint64_t>(x);
    ASSERT_LE(std::fabs(static_cast<double>((found - exact) / exact)), 3 * 0x1p-53) << x;
  }
  EXPECT_EQ((PortableExpm1<double, std::uint64_t>(0.0)), 0.0);
}

TEST(PortableLog, IsWithinTwoUlpOfTheLongDoubleLogarithm) {
  RandomStream random(3);
  for (int k = 0; k < 200000; ++k) {
    const double x = std::exp(-600 + 1200 * random.Uniform());
    const long double exact = std::log(static_cast<long double>(x));
    const double error = static_cast<double>(PortableLog(x) - exact);
    ASSERT_LE(std::fabs(error), 0x1p-51 * std::fmax(std::fabs(std::log(x)), 1.0)) << x;
  }
  EXPECT_NEAR(PortableLog(1.0), 0, 0x1p-51);
}

TEST(LogUpperBound, IsAboveTheLogarithmByLittle) {
  RandomStream random(2);
  for (int k = 0; k < 100000; ++k) {
    const double x = std::exp(-600 + 1200 * random.Uniform());
    const double bound = LogUpperBound(x);
    ASSERT_GE(bound, std::log(x) - 1e-12) << x;
    ASSERT_LE(bound, std::log(x) + 0.07) << x;
  }
}

}  // namespace
}  // namespace lyrefit
