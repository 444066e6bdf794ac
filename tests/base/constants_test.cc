#include "lyrefit/base/constants.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(ThermalVoltageTest, IsKTOverQ) {
  EXPECT_DOUBLE_EQ(ThermalVoltage(298.15), 1.380649e-23 * 298.15 / 1.602176634e-19);
  EXPECT_NEAR(ThermalVoltage(298.15), 0.025692579, 1e-9);
  EXPECT_DOUBLE_EQ(ThermalVoltage(600), 2 * ThermalVoltage(300));
}

TEST(ThermalVoltageTest, SetsOfConstantsDifferInTheSixthDigit) {
  const double codata = ThermalVoltage(306.15, ConstantSet::kCodata);
  EXPECT_NEAR(ThermalVoltage(306.15, ConstantSet::kLiterature) / codata - 1, 1.050e-6, 1e-9);
  EXPECT_NEAR(ThermalVoltage(306.15, ConstantSet::kPaper) / codata - 1, 4.85e-6, 2e-8);
}

TEST(ThermalVoltageDeathTest, AbsoluteZeroIsAProgrammingError) {
  EXPECT_DEATH(ThermalVoltage(0), "temperature_K");
}

TEST(ConstantSetTest, EverySetHasItsText) {
  EXPECT_EQ(AllTexts<ConstantSet>(), "codata, literature, paper");
}

}  // namespace
}  // namespace lyrefit
