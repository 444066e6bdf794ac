#include "lyrefit/trend/trend_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_of.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/single_diodes.h"
#include "lyrefit/read/read_pvlib.h"
#include "lyrefit/trend/trend_series.h"
#include "temp_folder.h"
#include "trend/made_sweeps.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(MaximumPowerPoint, IsThatOfAFineGrid) {
  const TrendDevice device = MadeDevice();
  for (const auto& [irradiance, temperature_C] :
       {std::pair{1000.0, 25.0}, {700.0, 60.0}, {50.0, 5.0}}) {
    for (const double shunt : {0.1, 1.0, 100.0}) {
      DeviceState state = MadeState(device, irradiance, temperature_C);
      state.shunt_conductance_S *= shunt;
      const TrendPoint found = MaximumPowerPoint(device, state, temperature_C);
      double best = 0, at_V = 0;
      for (double junction = 0; junction < 45; junction += 1e-3) {
        const double current = JunctionCurrent(device, state, junction, temperature_C);
        const double voltage = junction - current * state.resistance_series_ohm;
        if (voltage * current <= best) continue;
        best = voltage * current;
        at_V = voltage;
      }
      EXPECT_NEAR(found.power_W(), best, 1e-7 * best);
      EXPECT_GE(found.power_W(), best * (1 - 1e-12));
      EXPECT_NEAR(found.voltage_V, at_V, 2e-3);
    }
  }
}

TEST(MaximumPowerPoint, OfOneDiodeIsThatOfTheKeyPoints) {
  TrendDevice device = MadeDevice();
  device.saturation_current_2_A = 0;
  for (const double irradiance : {1000.0, 300.0, 20.0}) {
    const DeviceState state = MadeState(device, irradiance, 40);
    const double shunt = 1 / state.shunt_conductance_S, thermal = device.ThermalVoltage(40);
    // A trend leaves out the 1 of exp() - 1.
    const double light_A = state.photocurrent_A - state.saturation_current_A;
    SingleDiodes one;
    one.size = 1;
    one.photocurrent = {&light_A, 0};
    one.saturation_current = {&state.saturation_current_A, 0};
    one.resistance_series = {&state.resistance_series_ohm, 0};
    one.resistance_shunt = {&shunt, 0};
    one.nNsVth = {&thermal, 0};
    double isc = 0, voc = 0, imp = 0, vmp = 0, pmp = 0, ix = 0, ixx = 0;
    KeyPointsOf(one, {&isc, &voc, &imp, &vmp, &pmp, &ix, &ixx});
    const TrendPoint found = MaximumPowerPoint(device, state, 40);
    EXPECT_NEAR(found.voltage_V, vmp, 1e-9 * vmp);
    EXPECT_NEAR(found.current_A, imp, 1e-9 * imp);
    EXPECT_NEAR(found.power_W(), pmp, 1e-11 * pmp);
  }
}

TEST(StateOf, OfTheLawsOwnParametersIsTheLaw) {
  const TrendDevice device = MadeDevice();
  const DeviceState made = MadeState(device, 600, 50);
  const double half =
      std::exp(0.5 * device.OpenCircuit(made.photocurrent_A, 50) / device.ThermalVoltage(50));
  const double second = made.saturation_current_2_A * half / made.photocurrent_A;
  const DeviceState state =
      StateOf(device, {0, 0.3, 0, second, 1 / 400.0}, device.Photocurrent(600, 50), 50);
  EXPECT_NEAR(state.photocurrent_A, made.photocurrent_A, 1e-12);
  EXPECT_NEAR(state.saturation_current_A / made.saturation_current_A, 1, 1e-10);
  EXPECT_NEAR(state.saturation_current_2_A / made.saturation_current_2_A, 1, 1e-10);
  EXPECT_EQ(state.resistance_series_ohm, made.resistance_series_ohm);
  EXPECT_EQ(state.shunt_conductance_S, made.shunt_conductance_S);
}

TEST(TrendDevice, OpenCircuitIsWhereTheDiodesTakeThePhotocurrent) {
  TrendDevice device = MadeDevice();
  device.shunt_conductance_S = 0;
  for (const double temperature_C : {-10.0, 25.0, 70.0}) {
    const DeviceState state = MadeState(device, 500, temperature_C);
    const double voc = device.OpenCircuit(state.photocurrent_A, temperature_C);
    EXPECT_NEAR(JunctionCurrent(device, state, voc, temperature_C), 0, 1e-9);
  }
}

TEST(ReduceSweep, RecoversWhatTheSweepWasMadeOf) {
  const TrendDevice device = MadeDevice();
  DeviceState state = MadeState(device, 700, 45);
  const double voltage_before = device.OpenCircuit(state.photocurrent_A, 45);
  state.photocurrent_A *= 0.93;
  state.resistance_series_ohm = 0.41;
  state.shunt_conductance_S = 1 / 150.0;
  const TrendRow row = ReduceSweep(device, MadeSweep(device, state, 700, 45, 200), kMadeStart_s);
  EXPECT_EQ(row.state, TrendRowState::kUsed);
  EXPECT_EQ(row.reason, "");
  EXPECT_EQ(row.time_s, kMadeStart_s);
  EXPECT_NEAR(row.temperature_C, 45, 1e-9);
  EXPECT_NEAR(row.parameters[kTrendLight], std::log(0.93), 1e-6);
  EXPECT_NEAR(row.parameters[kTrendSeries], 0.41, 1e-5);
  EXPECT_NEAR(row.parameters[kTrendVoltage], 0, 1e-4 * voltage_before);
  EXPECT_NEAR(row.parameters[kTrendShunt], 1 / 150.0, 1e-6);
  EXPECT_EQ(row.lost_substrings, 0);
  const TrendPoint maximum = MaximumPowerPoint(device, state, 45);
  EXPECT_NEAR(row.power_W(), maximum.power_W(), 1e-3 * maximum.power_W());
}

TEST(ReduceSweep, CountsSubstringsWithoutVoltage) {
  const TrendDevice device = MadeDevice();
  const DeviceState state = MadeState(device, 700, 45);
  IvCurve curve = MadeSweep(device, state, 700, 45);
  for (int lost = 1; lost < 3; ++lost) {
    IvCurve shorter = curve;
    for (double& voltage : shorter.voltage_V) voltage *= 1 - lost / 3.0;
    const TrendRow row = ReduceSweep(device, shorter, 0);
    EXPECT_EQ(row.lost_substrings, lost);
    EXPECT_NEAR(row.parameters[kTrendSeries], 0.3, 1e-4);  // of the whole device
    EXPECT_NEAR(row.parameters[kTrendVoltage], 0, 1e-3);
  }
  TrendDevice unknown = device;
  unknown.substrings = 0;
  for (double& voltage : curve.voltage_V) voltage *= 2 / 3.0;
  EXPECT_EQ(ReduceSweep(unknown, curve, 0).lost_substrings, 0);
}

TEST(ReduceSweep, SaysWhyASweepIsUnusable) {
  const TrendDevice device = MadeDevice();
  const IvCurve good = MadeSweep(device, MadeState(device, 700, 45), 700, 45);
  const auto reason_of = [&](const auto& spoil) {
    IvCurve curve = good;
    spoil(&curve);
    const TrendRow row = ReduceSweep(device, curve, 0);
    EXPECT_EQ(row.state, TrendRowState::kUnusable);
    return row.reason;
  };
  EXPECT_EQ(reason_of([](IvCurve* curve) {
              curve->voltage_V.resize(7);
              curve->current_A.resize(7);
            }),
            "fewer than eight readings");
  EXPECT_EQ(reason_of([](IvCurve* curve) { curve->irradiance_known = false; }), "no irradiance");
  EXPECT_EQ(reason_of([](IvCurve* curve) { curve->temperature_known = false; }), "no temperature");
  EXPECT_EQ(reason_of([](IvCurve* curve) { curve->conditions.irradiance_W_m2 = 0; }), "dark");
  EXPECT_EQ(reason_of([](IvCurve* curve) {
              for (double& current : curve->current_A) current = -1;
            }),
            "no short circuit or no open circuit");
}

TEST(DeviceOfSweeps, IsTheLawOfTheSweeps) {
  const TrendDevice device = MadeDevice();
  MadeYear year;
  year.days = 10;
  year.noise = year.light_error = year.temperature_error_K = 0;
  const std::vector<TimedSweep> sweeps = MakeSweeps(device, year);
  std::vector<const IvCurve*> curves;
  for (const TimedSweep& sweep : sweeps) curves.push_back(&sweep.curve);
  const auto found = DeviceOfSweeps(curves);
  ASSERT_TRUE(found) << found.error().ToString();
  EXPECT_EQ(found->cells_in_series, 60);
  EXPECT_EQ(found->substrings, 3);
  EXPECT_NEAR(found->photocurrent_A, 9, 1e-3);
  EXPECT_NEAR(found->resistance_series_ohm, 0.3, 0.02);
  EXPECT_NEAR(found->shunt_conductance_S, 1 / 400.0, 3e-4);
  EXPECT_NEAR(found->OpenCircuit(6, 40), device.OpenCircuit(6, 40), 0.02);
}

TEST(SeriesOfSweeps, SaysWhatToRunOnFewSweepsThatEndBelowOpenCircuit) {
  TimedSweep sweep;
  sweep.curve.irradiance_known = sweep.curve.temperature_known = true;
  for (int k = 0; k < 20; ++k) {
    sweep.curve.voltage_V.push_back(k);
    sweep.curve.current_A.push_back(5 - 0.01 * k);
  }
  const std::vector<TimedSweep> few(3, sweep);
  EXPECT_THAT(
      MessageOf(SeriesOfSweeps(few, {})),
      AllOf(StartsWith("expected sweeps from 0 V to open circuit"),
            HasSubstr("at 5 times or more, found 3; "), HasSubstr("lyrefit fit FILES --csv")));
  EXPECT_THAT(MessageOf(SeriesOfSweeps(std::vector<TimedSweep>(30, sweep), {})),
              StartsWith("expected sweeps from 0 V to open circuit"));
}

TEST(DeviceOfSweeps, NeedsASweepWithItsConditions) {
  const TrendDevice device = MadeDevice();
  IvCurve curve = MadeSweep(device, MadeState(device, 700, 45), 700, 45);
  curve.irradiance_known = false;
  EXPECT_THAT(MessageOf(DeviceOfSweeps({&curve})),
              HasSubstr("with their irradiance and temperature"));
  EXPECT_THAT(MessageOf(DeviceOfSweeps({})), HasSubstr("found none"));
}

TEST(DeviceOfModule, HasTheCurvesOfTheModuleFile) {
  const TempFolder folder;
  const auto module = ReadPvlibParameters(folder.Write(
      "module.json", R"({"alpha_sc": 0.0045, "a_ref": 1.55, "I_L_ref": 9.1, "I_o_ref": 1.2e-10,
                         "R_s": 0.31, "R_sh_ref": 400, "cells_in_series": 60})"));
  ASSERT_TRUE(module) << module.error().ToString();
  const auto device = DeviceOfModule(*module);
  ASSERT_TRUE(device) << device.error().ToString();
  EXPECT_EQ(device->cells_in_series, 60);
  EXPECT_EQ(device->saturation_current_2_A, 0);
  EXPECT_DOUBLE_EQ(device->photocurrent_A, 9.1);
  EXPECT_DOUBLE_EQ(device->resistance_series_ohm, 0.31);
  EXPECT_DOUBLE_EQ(device->shunt_conductance_S, 1 / 400.0);
  for (const double temperature_C : {25.0, 60.0}) {
    DeviceState state = MadeState(*device, 1000, temperature_C);
    const TranslatedDevice at =
        TranslateTo(module->translation, module->shared, 1000, temperature_C + kZeroCelsius_K);
    const TrendPoint point = MaximumPowerPoint(*device, state, temperature_C);
    const std::vector<double> voltage = {point.voltage_V};
    EXPECT_NEAR(SolveCurrents(at.device, at.parameters.data(), voltage).front(), point.current_A,
                1e-7 * point.current_A)
        << temperature_C;
  }
}

TEST(DeviceOfModule, RefusesTwoDiodes) {
  TranslationSpec spec;
  spec.model = Model::kDoubleDiode;
  NamedParameters module;
  module.name = "two.json";
  module.translation = *MakeTranslation(spec);
  module.shared.assign(module.translation.parameters.size(), 1);
  const auto device = DeviceOfModule(module);
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().file, "two.json");
  EXPECT_THAT(device.error().message, HasSubstr("this one has two"));
}

}  // namespace
}  // namespace lyrefit
