#include "lyrefit/model/model_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

TEST(ModelKeyPoints, LieOnTheCurveAndAtTheSummitOfThePower) {
  Conditions conditions;
  conditions.cell_temperature_K = 306.15;
  const Device device = MakeDevice(Model::kSingleDiode, conditions);
  const double p[] = {0.7607879665, 3.1068454826e-07, 1.4772677708, 0.03654694602, 52.88978738};
  const KeyPoints points = ModelKeyPoints(device, p);
  const auto current = [&](double v) { return SolveOperatingPoint(device, p, v).current_A; };
  EXPECT_NEAR(points.short_circuit_current_A, current(0), 1e-15);
  EXPECT_NEAR(current(points.open_circuit_voltage_V), 0, 1e-12);
  const double v = points.max_power_voltage_V;
  EXPECT_NEAR(points.max_power_W, v * current(v), 1e-12);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_LT((v + step) * current(v + step), points.max_power_W);
  }
  EXPECT_NEAR(points.fill_factor,
              points.max_power_W / (points.short_circuit_current_A * points.open_circuit_voltage_V),
              1e-14);
}

TEST(ModelKeyPoints, AreFoundWhateverTheResistances) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  for (const double rs : {0.0, 1e-4, 0.05, 0.5}) {
    for (const double rsh : {1.0, 50.0, 1e12}) {
      const double p[] = {0.76, 3e-7, 1.48, rs, rsh};
      const KeyPoints points = ModelKeyPoints(device, p);
      EXPECT_DOUBLE_EQ(points.open_circuit_voltage_V, ModelOpenCircuit(device, p));
      const auto power = [&](double v) { return v * SolveOperatingPoint(device, p, v).current_A; };
      const double v = points.max_power_voltage_V;
      EXPECT_NEAR(points.max_power_W, power(v), 1e-13) << rs << " " << rsh;
      EXPECT_LT(std::max(power(0.999 * v), power(1.001 * v)), points.max_power_W);
      EXPECT_NEAR(power(points.open_circuit_voltage_V), 0, 1e-12);
    }
  }
}

TEST(ModelKeyPoints, OfADarkDeviceAreUnknown) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  const double p[] = {0, 1e-9, 1.2, 0.01, 50};
  const KeyPoints points = ModelKeyPoints(device, p);
  EXPECT_NEAR(points.short_circuit_current_A, 0, 1e-20);
  EXPECT_TRUE(std::isnan(points.open_circuit_voltage_V));
  EXPECT_TRUE(std::isnan(points.max_power_W));
}

}  // namespace
}  // namespace lyrefit
