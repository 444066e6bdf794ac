#include "lyrefit/model/device.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lyrefit {
namespace {

TEST(MakeDevice, NamesParametersAsPvlibAndThePapersDo) {
  const Device device = MakeDevice(Model::kTripleDiode, {});
  ASSERT_EQ(device.size(), 9);
  EXPECT_EQ(device.parameters[kRs].name, "resistance_series");
  EXPECT_EQ(device.parameters[1].symbol, "Is1");
  EXPECT_EQ(device.parameters[IdealityIndex(2)].name, "n_3");
  EXPECT_EQ(device.Find("saturation_current_2"), SaturationCurrentIndex(1));
  EXPECT_EQ(device.Find("n1"), IdealityIndex(0));
  EXPECT_FALSE(device.Find("n4").has_value());
}

TEST(MakeDevice, StartsARicherModelWithThePoorerOne) {
  const Device rich = MakeDevice(Model::kDoubleDiode, {});
  const Device poor = MakeDevice(Model::kSingleDiode, {});
  for (int i = 0; i < poor.size(); ++i) {
    EXPECT_EQ(rich.parameters[i].name, poor.parameters[i].name);
  }
}

TEST(JunctionCurrent, IsTheShockleyEquation) {
  Conditions conditions;
  conditions.cells_in_series = 10;
  conditions.cell_temperature_K = 300;
  const Device device = MakeDevice(Model::kDoubleDiode, conditions);
  const double p[] = {5, 1e-9, 1.2, 0.5, 100, 1e-6, 2};
  const double vt = 10 * 1.380649e-23 * 300 / 1.602176634e-19;
  for (const double vd : {-5.0, 0.0, 4.0, 6.0}) {
    const double expected =
        5 - 1e-9 * std::expm1(vd / (1.2 * vt)) - 1e-6 * std::expm1(vd / (2 * vt)) - vd / 100;
    EXPECT_NEAR(JunctionCurrent(device, p, vd), expected, 1e-13 * (5 + std::fabs(expected)));
  }
  EXPECT_NEAR(ExplicitCurrent(device, p, 4.0, 2.0), JunctionCurrent(device, p, 5.0), 1e-14);
}

TEST(MakeDevice, FollowsTheChosenConstants) {
  const Device paper = MakeDevice(Model::kSingleDiode, {}, ConstantSet::kPaper);
  const Device codata = MakeDevice(Model::kSingleDiode, {}, ConstantSet::kCodata);
  EXPECT_NE(paper.module_thermal_voltage_V, codata.module_thermal_voltage_V);
  EXPECT_NEAR(paper.module_thermal_voltage_V / codata.module_thermal_voltage_V, 1, 1e-5);
}

}  // namespace
}  // namespace lyrefit
