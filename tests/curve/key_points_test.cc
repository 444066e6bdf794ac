#include "lyrefit/curve/key_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

// P = V I is a parabola with its top at 3 V: I = 6 - V.
const std::vector<double> kLineVoltage = {-1, 0, 1, 2.5, 3.2, 5, 6, 7};
const std::vector<double> kLineCurrent = {7, 6, 5, 3.5, 2.8, 1, 0, -1};

void ExpectLine(const KeyPoints& key) {
  EXPECT_NEAR(key.short_circuit_current_A, 6, 1e-12);
  EXPECT_NEAR(key.open_circuit_voltage_V, 6, 1e-12);
  EXPECT_NEAR(key.max_power_voltage_V, 3, 1e-12);
  EXPECT_NEAR(key.max_power_current_A, 3, 1e-12);
  EXPECT_NEAR(key.max_power_W, 9, 1e-12);
  EXPECT_NEAR(key.fill_factor, 0.25, 1e-12);
}

TEST(FindKeyPointsTest, StraightLineIsFoundExactly) {
  ExpectLine(FindKeyPoints(kLineVoltage, kLineCurrent));
}

TEST(FindKeyPointsTest, OrderDoesNotMatter) {
  RandomStream random(3);
  std::vector<double> voltage = kLineVoltage;
  std::vector<double> current = kLineCurrent;
  for (std::uint32_t i = voltage.size(); i > 1; --i) {
    const std::uint32_t j = random.Index(i);
    std::swap(voltage[i - 1], voltage[j]);
    std::swap(current[i - 1], current[j]);
  }
  ExpectLine(FindKeyPoints(voltage, current));
}

TEST(FindKeyPointsTest, ReadingsAtOneVoltageCountWithTheirMean) {
  std::vector<double> voltage = kLineVoltage;
  std::vector<double> current = kLineCurrent;
  for (const double deviation : {0.1, -0.1}) {
    voltage.push_back(4);
    current.push_back(2 + deviation);
  }
  ExpectLine(FindKeyPoints(voltage, current));
}

TEST(FindKeyPointsTest, RtcFranceHasItsKnownValues) {
  const auto curve = ReadCurve(LYREFIT_DATA_DIR "/rtc_france");
  ASSERT_TRUE(curve);
  const KeyPoints key = FindKeyPoints(curve->voltage_V, curve->current_A);
  EXPECT_DOUBLE_EQ(key.short_circuit_current_A, 0.7605);
  EXPECT_NEAR(key.open_circuit_voltage_V, 0.5727, 5e-5);
  EXPECT_NEAR(key.max_power_voltage_V, 0.4507, 5e-4);
  EXPECT_NEAR(key.max_power_W, 0.3107, 2e-4);
  EXPECT_NEAR(key.fill_factor, 0.7135, 1e-3);
}

TEST(FindKeyPointsTest, ExtrapolatesATwentiethOfTheRangeAndNoMore) {
  const KeyPoints near = FindKeyPoints({0.2, 1, 2, 3, 4, 5, 5.8}, {5.8, 5, 4, 3, 2, 1, 0.2});
  EXPECT_NEAR(near.short_circuit_current_A, 6, 1e-12);
  EXPECT_NEAR(near.open_circuit_voltage_V, 6, 1e-12);
  const KeyPoints far = FindKeyPoints({0.4, 1, 2, 3, 4, 5, 5.6}, {5.6, 5, 4, 3, 2, 1, 0.4});
  EXPECT_TRUE(std::isnan(far.short_circuit_current_A));
  EXPECT_TRUE(std::isnan(far.open_circuit_voltage_V));
  EXPECT_TRUE(std::isnan(far.fill_factor));
  EXPECT_NEAR(far.max_power_W, 9, 1e-12);
}

TEST(FindKeyPointsTest, ReverseBranchAloneIsExtrapolatedToShortCircuit) {
  const KeyPoints key = FindKeyPoints({-5, -3, -1, -0.1}, {6, 5.6, 5.2, 5.02});
  EXPECT_NEAR(key.short_circuit_current_A, 5, 1e-12);
  EXPECT_TRUE(std::isnan(key.open_circuit_voltage_V));
  EXPECT_TRUE(std::isnan(key.max_power_W));
}

TEST(FindKeyPointsTest, NoisyEndIsNotExtrapolatedOnTwoNeighbours) {
  // The last two readings, 1 mV apart, rise by noise; the trend of the readings before them is
  // extrapolated.
  const KeyPoints key =
      FindKeyPoints({0, 1, 2, 3, 4, 5, 5.8, 5.801}, {6, 5, 4, 3, 2, 1, 0.198, 0.2});
  EXPECT_NEAR(key.open_circuit_voltage_V, 6, 0.01);
}

TEST(FindKeyPointsTest, MaximumAtTheEndIsTheBestPoint) {
  const KeyPoints key = FindKeyPoints({0, 0.1, 0.2, 0.3}, {1, 1, 1, 0.99});
  EXPECT_EQ(key.max_power_voltage_V, 0.3);
  EXPECT_EQ(key.max_power_current_A, 0.99);
}

TEST(FindKeyPointsTest, NoiseBetweenCloseNeighboursDoesNotLiftTheMaximum) {
  const KeyPoints key = FindKeyPoints({0, 1, 1.001, 2}, {1, 1, 0.9, 0});
  EXPECT_EQ(key.max_power_W, 1);
  EXPECT_EQ(key.max_power_voltage_V, 1);
}

TEST(FindKeyPointsTest, LastPointAtZeroCurrentIsOpenCircuit) {
  EXPECT_EQ(FindKeyPoints({0, 17.1, 21.1}, {3.8, 3.5, 0}).open_circuit_voltage_V, 21.1);
}

TEST(FindKeyPointsTest, DarkCurveDeliversNothing) {
  const KeyPoints key = FindKeyPoints({-1, 0, 0.5, 0.6}, {0.01, 0, -0.1, -1});
  EXPECT_EQ(key.short_circuit_current_A, 0);
  EXPECT_EQ(key.open_circuit_voltage_V, 0);
  EXPECT_TRUE(std::isnan(key.max_power_W));
  EXPECT_TRUE(std::isnan(key.fill_factor));
}

TEST(FindKeyPointsTest, TooFewPointsGiveNothing) {
  EXPECT_TRUE(std::isnan(FindKeyPoints({}, {}).max_power_W));
  EXPECT_TRUE(std::isnan(FindKeyPoints({0.5}, {1}).max_power_W));
  EXPECT_TRUE(std::isnan(FindKeyPoints({0.5, 0.5}, {1, 2}).short_circuit_current_A));
}

}  // namespace
}  // namespace lyrefit
