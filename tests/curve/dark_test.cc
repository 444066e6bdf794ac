#include "lyrefit/curve/dark.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"

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

TEST(DarkTest, NothingButNoiseIsNightWhereNoLightIsStated) {
  IvCurve curve;
  RandomStream random(3);
  for (int k = 0; k < 40; ++k) {
    curve.voltage_V.push_back(0.1 * k);
    curve.current_A.push_back(2e-3 * random.Normal());
  }
  curve.current_A[0] = 4e-3;
  for (const double irradiance : {0.0, 3.0}) {
    curve.conditions.irradiance_W_m2 = irradiance;
    EXPECT_TRUE(IsNight(curve)) << irradiance;
    EXPECT_TRUE(IsDark(curve)) << irradiance;
  }
  curve.conditions.irradiance_W_m2 = 800;
  EXPECT_FALSE(IsNight(curve)) << "a device that is off, or a dead channel";
  curve.conditions.irradiance_W_m2 = 0;
  curve.current_A.back() = -1;
  EXPECT_FALSE(IsNight(curve)) << "driven forward";
  EXPECT_FALSE(IsNight(Falling(0, 0))) << "too few readings tell no noise";
}

// A photodiode from -1 to 1 V with 50 mA forward. Noise of the currents: constant.
IvCurve Photodiode(double photo_A, double noise_A, double loop_A = 0) {
  IvCurve curve;
  curve.irradiance_known = false;
  RandomStream random(5);
  for (const double direction : {1.0, -1.0}) {
    for (int k = 0; k <= 50; ++k) {
      const double voltage_V = direction * (-1 + 0.04 * k);
      const double diode_A = 1e-9 * std::expm1(voltage_V / 0.0565);
      curve.voltage_V.push_back(voltage_V);
      curve.current_A.push_back(photo_A - diode_A - voltage_V / 1e6 - direction * loop_A +
                                noise_A * random.Normal());
    }
  }
  return curve;
}

TEST(DarkTest, APhotocurrentAboveItsNoiseIsLightHoweverLargeTheForwardCurrentIs) {
  EXPECT_FALSE(IsDark(Photodiode(1e-6, 1e-8)));
  EXPECT_TRUE(IsDark(Photodiode(1e-6, 1e-7))) << "may be an offset";
  EXPECT_TRUE(IsDark(Photodiode(-1e-6, 1e-8)));
  EXPECT_TRUE(IsDark(Photodiode(1e-8, 1e-9))) << "an offset of ten times the noise";
  EXPECT_TRUE(IsDark(Photodiode(0, 1e-9, 1e-7))) << "the charge of a sweep up and down";
  IvCurve stated = Photodiode(1e-6, 1e-7);
  stated.irradiance_known = true;
  EXPECT_FALSE(IsDark(stated)) << "light is stated";
  stated.conditions.irradiance_W_m2 = 0;
  EXPECT_TRUE(IsDark(stated)) << "darkness is stated";
}

// 60 readings from `from_V`: currents of `photo_A` up to 0.4 V, then a diode to 1 A, with noise.
IvCurve Coarse(double from_V, double photo_A, double noise_A, std::uint64_t seed) {
  IvCurve curve;
  curve.irradiance_known = false;
  RandomStream random(seed);
  for (int k = 0; k < 60; ++k) {
    const double voltage_V = from_V + (0.8 - from_V) * k / 59;
    curve.voltage_V.push_back(voltage_V);
    curve.current_A.push_back(photo_A - std::expm1(voltage_V / 0.04) / std::expm1(20.0) +
                              noise_A * random.Normal());
  }
  return curve;
}

TEST(DarkTest, NoiseOfEitherSignIsNoPhotocurrent) {
  int dark = 0;
  constexpr int kDraws = 100;
  for (int seed = 0; seed < kDraws; ++seed) {
    dark += IsDark(Coarse(-0.3, 0, 6e-3, seed)) ? 1 : 0;
    for (const double from_V : {-0.3, 0.0}) {
      EXPECT_FALSE(IsDark(Coarse(from_V, 0.02, 3e-3, seed))) << from_V;
      EXPECT_FALSE(IsDark(Coarse(from_V, 0.003, 1e-4, seed))) << from_V;
      EXPECT_FALSE(IsDark(Coarse(from_V, 0.3, 0.03, seed))) << from_V;
    }
  }
  EXPECT_GE(dark, kDraws - 2);
}

}  // namespace
}  // namespace lyrefit
