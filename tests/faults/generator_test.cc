#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "faults/base_fit.h"
#include "faults/case.h"
#include "faults/cell.h"
#include "faults/measure.h"
#include "faults/series_string.h"

namespace faults {
namespace {

Device Plain() {
  Device device;
  device.photocurrent = 5;
  device.resistance = 0.004;
  device.conductance = 0.2;
  device.open_circuit = 0.62;
  SetSecondDiode(0, &device);
  return device;
}

Cell At25(const Device& device, const Effects& effects = {}) {
  return CellUnder(device, effects, 1, kReferenceK);
}

TEST(HiddenCell, HoldsItsLawWithEveryTermPresent) {
  Device device = Plain();
  ASSERT_TRUE(SetSecondDiode(1e-6, &device));
  Effects effects;
  effects.shunt_strength = 0.05;
  effects.breakdown = 0.01;
  effects.collection = 0.01;
  effects.lumped_drop = 1e-4;
  effects.inverse_contact = 0.1;
  const Cell cell = At25(device, effects);
  for (double voltage = -4; voltage < 0.7; voltage += 0.0625) {
    const double current = CellCurrent(cell, voltage);
    const double drop = current * (cell.resistance + cell.lumped_drop * std::fabs(current)) +
                        cell.thermal_voltage * std::log1p(0.1 * current);
    EXPECT_NEAR(JunctionCurrent(cell, voltage + drop), current, 1e-10) << voltage;
    EXPECT_NEAR(CellVoltage(cell, current), voltage, 1e-9);
  }
}

TEST(HiddenCell, HasNoCurrentAtItsOpenCircuit) {
  const Device device = Plain();
  EXPECT_NEAR(CellCurrent(At25(device), device.open_circuit), 0, 1e-12);
}

TEST(HiddenCell, HalvesWithoutLateralResistanceAreOneCell) {
  Effects effects;
  effects.far_ohm = 1e-12;
  EXPECT_NEAR(CellCurrent(At25(Plain(), effects), 0.5), CellCurrent(At25(Plain()), 0.5), 1e-8);
}

TEST(HiddenCell, BlockingContactLimitsTheForwardCurrent) {
  Effects effects;
  effects.inverse_contact = 2;
  const double current = CellCurrent(At25(Plain(), effects), 1.5);
  EXPECT_GT(current, -0.5);
  EXPECT_NEAR(current, -0.5, 0.01);
}

TEST(HiddenString, EqualCellsShareTheVoltage) {
  const Cell cell = At25(Plain());
  const std::vector<Substring> string = {{{{cell, 20}}, 3, true, false, 0.5, 5}};
  for (const double voltage : {0.0, 20.0, 30.0, 36.0, 38.0}) {
    EXPECT_NEAR(StringCurrent(string, voltage), CellCurrent(cell, voltage / 60), 1e-9);
  }
}

TEST(HiddenString, BypassedPartAddsItsDiodesDrop) {
  const Cell lit = At25(Plain());
  Cell shaded = lit;
  shaded.photocurrent *= 0.3;
  for (const bool ideal : {true, false}) {
    const std::vector<Substring> string = {{{{lit, 20}}, 2, false, false, 0, 5},
                                           {{{shaded, 20}}, 1, true, ideal, 0.4, 5}};
    const double voltage = 40 * CellVoltage(lit, 4.9) - 0.4;
    EXPECT_NEAR(StringCurrent(string, voltage), 4.9, ideal ? 1e-9 : 0.02);
  }
}

TEST(HiddenMeasure, CapacitanceDrawsItsChargingCurrent) {
  Random random(3);
  Device device = Plain();
  device.resistance = 1e-9;
  Plan plan = DrawPlan(Kind::kUpDown, device, &random);
  Effects effects;
  effects.capacitance = 1e-4;
  const std::vector<double> still = ExactCurrents(device, {}, plan);
  const std::vector<double> moving = ExactCurrents(device, effects, plan);
  for (std::size_t i = 1; i < still.size(); ++i) {
    const Setting& now = plan.settings[i];
    const Setting& before = plan.settings[i - 1];
    const double rate = (now.voltage - before.voltage) / (now.time_s - before.time_s);
    EXPECT_NEAR(still[i] - moving[i], 1e-4 * rate, 1e-6 * std::fabs(rate) + 1e-9);
  }
}

TEST(HiddenMeasure, SkewMovesTheCurrentsByReadings) {
  Random random(4);
  const Device device = Plain();
  const Plan plan = DrawPlan(Kind::kUpDown, device, &random);
  Effects effects;
  effects.skew_s = plan.settings[1].time_s - plan.settings[0].time_s;
  const std::vector<double> still = ExactCurrents(device, {}, plan);
  const std::vector<double> late = ExactCurrents(device, effects, plan);
  for (std::size_t i = 0; i + 1 < still.size(); ++i) EXPECT_NEAR(late[i], still[i + 1], 1e-9);
}

TEST(HiddenBaseFit, FindsAnotherDeviceBehindExactCurrents) {
  for (int i = 0; i < 12; ++i) {
    Random random(i);
    DeviceWish wish;
    wish.module = i % 2 == 1;
    const Device device = DrawDevice(wish, &random);
    const Plan plan = DrawPlan(static_cast<Kind>(i % kKinds), device, &random);
    const std::vector<double> exact = ExactCurrents(device, {}, plan);
    const std::vector<double> sigmas(exact.size(), 1e-3 * device.photocurrent);
    Device start = device;
    start.photocurrent *= 1.01;
    start.ideality *= 1.1;
    start.resistance *= 0.7;
    start.conductance *= 2;
    SetSecondDiode(0, &start);
    const BaseFit fit = FitBase(start, plan, exact, sigmas);
    EXPECT_LT(fit.Misfit(), 1e-3) << Name(plan.kind);
    EXPECT_NEAR(fit.device.ideality, device.ideality, 1e-3) << Name(plan.kind);
  }
}

TEST(HiddenCase, IsTheSameFromTheSameSeed) {
  Request request;
  request.kind = Kind::kUpDown;
  request.injections = {FindInjection("drift")};
  request.seed = 9;
  const auto first = MakeCase(request), again = MakeCase(request);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->measurement.current, again->measurement.current);
  request.seed = 10;
  EXPECT_NE(MakeCase(request)->measurement.current, first->measurement.current);
}

class Showing : public testing::TestWithParam<int> {};

TEST_P(Showing, EveryEffectCanBeMadeToShow) {
  const Kind kind = static_cast<Kind>(GetParam());
  for (const Injection& injection : Injections()) {
    if (!Shows(injection, kind) || std::string(injection.name) == "temperature_or_cells") continue;
    Request request;
    request.kind = kind;
    request.injections = {&injection};
    request.seed = 5;
    const std::optional<Case> made = MakeCase(request);
    ASSERT_TRUE(made) << injection.name;
    EXPECT_NEAR(made->causes[0].misfit, 12, 0.5) << injection.name;
  }
}

TEST_P(Showing, WhatIsAbsorbedShowsNothing) {
  for (const Injection& injection : Absorbed()) {
    if (!Shows(injection, static_cast<Kind>(GetParam()))) continue;
    for (int i = 0; i < 20; ++i) {
      Random random(i);
      DeviceWish wish;
      wish.bypass = false;
      Scene scene;
      scene.device = DrawDevice(wish, &random);
      scene.plan = DrawPlan(static_cast<Kind>(GetParam()), scene.device, &random);
      scene.noise = DrawNoise(NoiseType::kMixed, scene.device.photocurrent, &random);
      EXPECT_LT(Misfit(scene), 1e-3);
      if (injection.apply(DrawShape(&random), 1, &scene)) {
        EXPECT_LT(Misfit(scene), 0.1) << injection.name << " " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Showing, testing::Range(0, kKinds), [](const auto& place) {
  return std::string(Name(static_cast<Kind>(place.param)));
});

}  // namespace
}  // namespace faults
