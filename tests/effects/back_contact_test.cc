#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// The loss of voltage is that at which the barrier's diode and its leak carry the current.
TEST(BackContactTest, ItsDiodeAndItsLeakCarryTheCurrent) {
  constexpr double kThermal_V = 0.0257, kInverse = 25, kIdeality = 2.5, kLeak = 0.4;
  Cell<Pack> cell;
  cell.thermal_voltage = Pack(kThermal_V);
  const Pack p[] = {kInverse, kIdeality, kLeak};
  for (const double current : {-3.0, -0.5, -0.041, -0.01, 0.0, 0.02, 0.4, 1.0}) {
    const auto loss =
        FindEffect("back_contact")->series.For<Pack>()(p, cell, Dual<1, Pack>(Pack(current), 0));
    const double voltage = loss.a[0], unit = kIdeality * kThermal_V;
    // A barrier without a leak has a thousandth of its slope at 0 V, so that no current is impossible.
    const double leak = kLeak + 3e-3 / (kInverse * unit);
    const double carried = std::expm1(voltage / unit) / kInverse + leak * voltage;
    EXPECT_NEAR(carried, current, 1e-12 * (1 + std::fabs(current)));
    const double slope = std::exp(voltage / unit) / (kInverse * unit) + leak;
    EXPECT_NEAR(loss.v[0][0], 1 / slope, 1e-9 / slope) << current;
  }
}

}  // namespace
}  // namespace lyrefit
