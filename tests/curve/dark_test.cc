#include "lyrefit/curve/dark.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

IvCurve Falling(double at_zero_A, double irradiance_W_m2) {
  IvCurve curve;
  curve.conditions.irradiance_W_m2 = irradiance_W_m2;
  curve.voltage_V = {-0.1, 0, 0.2, 0.4, 0.6};
  curve.current_A = {at_zero_A + 1e-4, at_zero_A, at_zero_A - 1e-4, at_zero_A - 0.01, -1};
  return curve;
}

TEST(DarkTest, WhatHasAPhotocurrentIsLitHoweverLittleLightThereIs) {
  for (const double irradiance : {1.0, 5.0, 10.0, 20.0, 1000.0}) {
    EXPECT_FALSE(IsDark(Falling(0.01, irradiance))) << irradiance;
    EXPECT_TRUE(IsDark(Falling(0.0005, irradiance))) << irradiance;
    EXPECT_FALSE(IsStatedDark(Falling(0.01, irradiance))) << irradiance;
  }
}

TEST(DarkTest, WhatIsStatedAsDarkMayHaveAnOffset) {
  EXPECT_TRUE(IsStatedDark(Falling(0, 0)));
  EXPECT_TRUE(IsDark(Falling(0.01, 0)));
  EXPECT_FALSE(IsDark(Falling(0.1, 0)));
  IvCurve assumed = Falling(0.01, 0);
  assumed.irradiance_known = false;
  EXPECT_FALSE(IsStatedDark(assumed));
  EXPECT_FALSE(IsDark(assumed));
}

}  // namespace
}  // namespace lyrefit
