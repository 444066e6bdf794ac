#include "lyrefit/curve/beyond_voc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {
namespace {

// A cell of 2 mA with n = 1.6, 30 ohm and Voc 0.65 V, swept to `to_V`. Beyond 0.67 V a second
// conduction of `injection` A/V2 takes more. `noise`: of each current, relative to Isc.
IvCurve SweptBeyond(double to_V, double injection, double noise = 5e-4) {
  constexpr double kIsc_A = 2e-3, kVoc_V = 0.65, kThermal_V = 1.6 * 0.0257, kRs_ohm = 30;
  const double saturation_A = kIsc_A / std::expm1(kVoc_V / kThermal_V);
  IvCurve curve;
  RandomStream random(3);
  for (double voltage_V = -0.1; voltage_V < to_V; voltage_V += 0.01) {
    double low = -1, high = 1;
    for (int step = 0; step < 100; ++step) {
      const double middle = (low + high) / 2;
      const double diode_A =
          kIsc_A - saturation_A * std::expm1((voltage_V + kRs_ohm * middle) / kThermal_V);
      (diode_A > middle ? low : high) = middle;
    }
    const double beyond_V = std::max(voltage_V - kVoc_V - 0.02, 0.0);
    const double current_A = low - injection * std::pow(beyond_V, 2);
    curve.voltage_V.push_back(voltage_V);
    curve.current_A.push_back(current_A + noise * kIsc_A * random.Normal());
  }
  return curve;
}

TEST(BeyondVocTest, ASweepThatOneDiodeDescribesStaysWhole) {
  for (const double to_V : {0.6, 0.68, 0.8, 1.5}) {
    const IvCurve curve = SweptBeyond(to_V, 0);
    EXPECT_EQ(FindBeyondVoc(curve).left_out, 0) << to_V;
    const IvCurve kept = WithoutBeyondVoc(curve);
    EXPECT_EQ(kept.current_A, curve.current_A) << to_V;
    EXPECT_TRUE(kept.assumptions.empty()) << to_V;
  }
}

TEST(BeyondVocTest, AnotherConductionIsLeftOutAndCounted) {
  IvCurve curve = SweptBeyond(1.2, 1);
  curve.time_s.resize(curve.size(), 1);
  const BeyondVoc beyond = FindBeyondVoc(curve);
  EXPECT_GT(beyond.left_out, 50);
  EXPECT_GT(beyond.largest_A, 20 * 2e-3);
  EXPECT_NEAR(beyond.last_V, 0.66, 0.011);
  const IvCurve kept = WithoutBeyondVoc(curve);
  EXPECT_EQ(kept.size() + static_cast<std::size_t>(beyond.left_out), curve.size());
  EXPECT_EQ(kept.time_s.size(), kept.size());
  EXPECT_LE(kept.voltage_V.back(), 0.67);
  EXPECT_LT(kept.current_A.back(), 0) << "the first reading beyond Voc stays";
  ASSERT_EQ(kept.assumptions.size(), 1U);
  EXPECT_THAT(kept.assumptions[0].sentence, testing::HasSubstr("readings beyond Voc"));
  EXPECT_EQ(WithoutBeyondVoc(kept).size(), kept.size()) << "once is enough";
}

TEST(BeyondVocTest, ASweepUpAndDownKeepsItsVoc) {
  IvCurve curve = SweptBeyond(1.2, 1);
  for (std::size_t k = curve.size(); k-- > 0;) {
    curve.voltage_V.push_back(curve.voltage_V[k] - 0.004);
    curve.current_A.push_back(curve.current_A[k]);
  }
  const IvCurve kept = WithoutBeyondVoc(curve);
  EXPECT_LT(kept.size(), curve.size());
  EXPECT_EQ(FindKeyPoints(kept.voltage_V, kept.current_A).open_circuit_voltage_V,
            FindKeyPoints(curve.voltage_V, curve.current_A).open_circuit_voltage_V);
}

// Few readings lie between the knee and Voc. More are needed to judge those beyond, but no more kept.
TEST(BeyondVocTest, ACoarseSweepEndsAtTheFirstReadingBeyondVoc) {
  const IvCurve fine = SweptBeyond(1.6, 1);
  IvCurve curve;
  for (std::size_t k = 0; k < fine.size(); k += 6) {
    curve.voltage_V.push_back(fine.voltage_V[k]);
    curve.current_A.push_back(fine.current_A[k]);
  }
  const IvCurve kept = WithoutBeyondVoc(curve);
  ASSERT_LT(kept.size(), curve.size());
  EXPECT_LT(kept.current_A.back(), 0);
  EXPECT_GT(kept.current_A[kept.size() - 2], 0);
}

TEST(BeyondVocTest, BelowIscOrAsItIsOrInTheDarkNothingIsLeftOut) {
  EXPECT_EQ(FindBeyondVoc(SweptBeyond(0.70, 1)).left_out, 0);
  IvCurve curve = SweptBeyond(1.2, 1);
  curve.as_is = true;
  EXPECT_EQ(WithoutBeyondVoc(curve).size(), curve.size());
  IvCurve dark = SweptBeyond(1.2, 1);
  for (double& current : dark.current_A) current -= 2e-3;
  EXPECT_EQ(FindBeyondVoc(dark).left_out, 0);
}

}  // namespace
}  // namespace lyrefit
