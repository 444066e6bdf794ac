#include "lyrefit/certify/relaxation.h"

#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/certify/interval.h"

namespace lyrefit {
namespace {

double Cut(const MixtureData& data) { return data.reference_voltage_V / data.current_A.maxCoeff(); }

TEST(BoundTail, HoldsForEveryMixtureAtLargerResistances) {
  for (std::uint64_t seed = 300; seed < 310; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const double bound = BoundTail(data, 0.5 * Cut(data));
    for (const double factor : {0.5, 0.7, 1.0, 1.5, 3.0, 20.0}) {
      const double rs = factor * Cut(data);
      const Mixture mixture = SolveMixture(data, {WindowOf(curve, 0.5, 4)}, rs, {}, 1e-6, 20);
      EXPECT_GE(mixture.primal, bound * (1 - 1e-12)) << curve.name << " Rs x " << factor;
    }
  }
}

TEST(BoundTail, ShutsOutLargeResistancesOnEveryShippedCurve) {
  for (const char* name : {"rtc_france", "pwp201", "stm6_40_36", "stp6_120_36", "msx60"}) {
    const MixtureData data = DataOf(Shipped(name));
    const double largest = data.current_A.maxCoeff();
    EXPECT_GT(BoundTail(data, Cut(data)), 0.1 * largest * largest) << name;
    EXPECT_LT(BoundTail(data, 0), 1e-3 * largest * largest) << name;
  }
}

TEST(BoundTail, IsTheMeanOfTwoPointsInTheWrongOrder) {
  MixtureData data;
  data.voltage_V = Eigen::Vector3d(0, 0.5, 1);
  data.current_A = Eigen::Vector3d(1, 0.5, 0);
  EXPECT_EQ(BoundTail(data, 0.9), 0);
  EXPECT_EQ(BoundTail(data, 1.1), 0.25);
}

// Beyond a sufficiently large Rs, the order of the points is that of their currents, and no mixture
// fits better than the mean current.
TEST(BoundTail, IsTheSpreadOfTheCurrentsFarOut) {
  for (std::uint64_t seed = 310; seed < 320; ++seed) {
    MixtureData data = DataOf(RandomCurve(seed));
    const double far = 1e12 * Cut(data);
    const double spread = 0.5 * (data.current_A.array() - data.current_A.mean()).square().sum();
    EXPECT_NEAR(BoundTail(data, far) / spread, 1, 1e-12) << seed;
    EXPECT_LE(BoundTail<Interval>(data, far), BoundTail(data, far)) << seed;
    EXPECT_NEAR(BoundTail<Interval>(data, far) / spread, 1, 1e-12) << seed;
  }
}

}  // namespace
}  // namespace lyrefit
