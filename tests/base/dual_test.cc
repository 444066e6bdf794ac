#include "lyrefit/base/dual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lyrefit {
namespace {

using Two = Dual<2>;

TEST(DualTest, ConstantsHaveNoDerivative) {
  const Two x = 3.5;
  EXPECT_EQ(x.a, 3.5);
  EXPECT_EQ(x.v[0], 0);
  EXPECT_EQ(x.v[1], 0);
  EXPECT_EQ(ValueOf(x), 3.5);
  EXPECT_EQ(ValueOf(2.5), 2.5);
}

TEST(DualTest, UnknownsHaveTheirOwn) {
  const Two y(2, 1);
  EXPECT_EQ(y.a, 2);
  EXPECT_EQ(y.v[0], 0);
  EXPECT_EQ(y.v[1], 1);
}

// Compares every operation with central differences, with duals and plain numbers on either side.
TEST(DualTest, OperationsDifferentiate) {
  const struct {
    const char* name;
    std::function<Two(Two, Two)> dual;
    std::function<double(double, double)> plain;
  } cases[] = {
      {"sum", [](Two x, Two y) { return x + y; }, [](double x, double y) { return x + y; }},
      {"difference", [](Two x, Two y) { return x - y; }, [](double x, double y) { return x - y; }},
      {"product", [](Two x, Two y) { return x * y; }, [](double x, double y) { return x * y; }},
      {"quotient", [](Two x, Two y) { return x / y; }, [](double x, double y) { return x / y; }},
      {"minus", [](Two x, Two) { return -x; }, [](double x, double) { return -x; }},
      {"plus number", [](Two x, Two y) { return (x + 2.0) * (3.0 + y); },
       [](double x, double y) { return (x + 2) * (3 + y); }},
      {"less number", [](Two x, Two y) { return (x - 2.0) * (3.0 - y); },
       [](double x, double y) { return (x - 2) * (3 - y); }},
      {"times number", [](Two x, Two y) { return x * 2.0 + 3.0 * y; },
       [](double x, double y) { return x * 2 + 3 * y; }},
      {"over number", [](Two x, Two y) { return x / 2.0 + 3.0 / y; },
       [](double x, double y) { return x / 2 + 3 / y; }},
      {"exp", [](Two x, Two y) { return exp(x * y); },
       [](double x, double y) { return std::exp(x * y); }},
      {"log", [](Two x, Two y) { return log(x * y); },
       [](double x, double y) { return std::log(x * y); }},
      {"sqrt", [](Two x, Two y) { return sqrt(x + y); },
       [](double x, double y) { return std::sqrt(x + y); }},
      {"abs", [](Two x, Two y) { return abs(x - 2.0 * y); },
       [](double x, double y) { return std::fabs(x - 2 * y); }},
  };
  constexpr double kX = 0.7, kY = 1.3, kStep = 1e-5;
  for (const auto& one : cases) {
    SCOPED_TRACE(one.name);
    const Two found = one.dual(Two(kX, 0), Two(kY, 1));
    EXPECT_NEAR(found.a, one.plain(kX, kY), 1e-15);
    const double by_x = (one.plain(kX + kStep, kY) - one.plain(kX - kStep, kY)) / (2 * kStep);
    const double by_y = (one.plain(kX, kY + kStep) - one.plain(kX, kY - kStep)) / (2 * kStep);
    EXPECT_NEAR(found.v[0], by_x, 1e-9);
    EXPECT_NEAR(found.v[1], by_y, 1e-9);
  }
}

TEST(DualTest, ChainTakesAnyFunction) {
  const Two x(0.4, 0);
  const Two sine = (2.0 * x).Chain(std::sin(0.8), std::cos(0.8));
  EXPECT_EQ(sine.a, std::sin(0.8));
  EXPECT_DOUBLE_EQ(sine.v[0], 2 * std::cos(0.8));
}

TEST(DualTest, ComparesByValue) {
  EXPECT_TRUE(Two(1, 0) < Two(2, 1));
  EXPECT_FALSE(Two(2, 0) < Two(2, 1));
}

}  // namespace
}  // namespace lyrefit
