#include <gtest/gtest.h>

#include <cmath>

#include "effects/synthetic_readings.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// The charging current is what the current differs from that of a slow sweep. It falls with the
// delivered current by exp(-b I).
TEST(CapacitanceTest, FallsWithTheCurrent) {
  const Readings readings = SyntheticReadings(DataKind::kUpDown, 60);
  const std::vector<double> slow = Currents(Law{}, readings, ParametersOf({}, readings));
  const auto charging = [&](const std::vector<double>& p) {
    const Settled at = WithEffect(*FindEffect("capacitance"), p, readings);
    std::vector<double> current = Currents(at.law, readings, at.p);
    for (std::size_t k = 0; k < current.size(); ++k) current[k] = slow[k] - current[k];
    return current;
  };
  for (const std::vector<double>& p : {std::vector<double>{0.01, 0, 0}, {0.004, 0.002, 0}}) {
    const std::vector<double> constant = charging(p), falling = charging({p[0], p[1], 3});
    for (std::size_t k = 0; k < slow.size(); ++k) {
      ASSERT_NE(constant[k], 0);
      const double delivered = std::max(slow[k], 0.0);
      EXPECT_NEAR(falling[k] / constant[k], std::exp(-3 * delivered), 1e-9) << k;
    }
  }
}

TEST(CapacitanceTest, IsTakenWithAndWithoutTheFall) {
  int with = 0, without = 0;
  for (const ShapeStart& start : FindEffect("capacitance")->starts({}, {}, {})) {
    (start.freed.empty() ? without : with) += 1;
  }
  EXPECT_GT(with, 0);
  EXPECT_GT(without, 0);
}

}  // namespace
}  // namespace lyrefit
