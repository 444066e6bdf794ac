#include "lyrefit/curve/iv_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace lyrefit {
namespace {

IvCurve Sound() {
  IvCurve curve;
  curve.voltage_V = {0, 0.5, 0.6};
  curve.current_A = {1, 0.9, 0};
  return curve;
}

TEST(ConditionsTest, ModuleThermalVoltageIsThatOfAllCells) {
  Conditions conditions;
  conditions.cells_in_series = 36;
  conditions.cell_temperature_K = 318.15;
  EXPECT_DOUBLE_EQ(conditions.ModuleThermalVoltage(ConstantSet::kCodata),
                   36 * ThermalVoltage(318.15));
}

TEST(ValidateTest, AcceptsASoundCurveWithAllColumns) {
  IvCurve curve = Sound();
  EXPECT_TRUE(Validate(curve));
  curve.sigma_A = {0.1, 0.1, 0.1};
  curve.time_s = {0, 1, 2};
  curve.sweep = {0, 0, 0};
  curve.irradiance_W_m2 = {1, 1, 1};
  curve.temperature_C = {25, 25, 25};
  EXPECT_TRUE(Validate(curve));
}

TEST(ValidateTest, NamesWhatEveryFitWouldStumbleOver) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    const char* phrase;
    std::function<void(IvCurve*)> spoil;
  } kCases[] = {
      {"3 values of current, found 2", [](IvCurve* c) { c->current_A.pop_back(); }},
      {"3 values of sigma, found 1", [](IvCurve* c) { c->sigma_A = {1}; }},
      {"3 values of sweep, found 1", [](IvCurve* c) { c->sweep = {1}; }},
      {"finite current at point 2", [&](IvCurve* c) { c->current_A[1] = nan; }},
      {"finite voltage at point 3", [&](IvCurve* c) { c->voltage_V[2] = nan; }},
      {"finite time at point 1",
       [&](IvCurve* c) {
         c->time_s = {nan, 1, 2};
       }},
      {"at least two points, found 1",
       [](IvCurve* c) {
         c->voltage_V = {0};
         c->current_A = {1};
       }},
      {"at least two points, found 0",
       [](IvCurve* c) {
         c->voltage_V.clear();
         c->current_A.clear();
       }},
      {"two different voltages, found 0.5 V at all 3",
       [](IvCurve* c) { c->voltage_V.assign(3, 0.5); }},
      {"positive sigma at point 2",
       [](IvCurve* c) {
         c->sigma_A = {1, 0, 1};
       }},
      {"cell temperature from -100 to 200 C",
       [](IvCurve* c) { c->conditions.cell_temperature_K = 25; }},
      {"cell temperature", [&](IvCurve* c) { c->conditions.cell_temperature_K = nan; }},
      {"irradiance from 0", [](IvCurve* c) { c->conditions.irradiance_W_m2 = -1; }},
      {"at least 1 cell in series", [](IvCurve* c) { c->conditions.cells_in_series = 0; }},
      {"at least 1 string in parallel", [](IvCurve* c) { c->conditions.strings_in_parallel = 0; }},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.phrase);
    IvCurve curve = Sound();
    c.spoil(&curve);
    const auto valid = Validate(curve);
    ASSERT_FALSE(valid);
    EXPECT_THAT(valid.error().message, ::testing::HasSubstr(c.phrase));
  }
}

TEST(FindSetupTest, KnowsTheWordsOfSetups) {
  EXPECT_EQ(FindSetup("Flasher: class A+A+A+"), Setup::kFlash);
  EXPECT_EQ(FindSetup("# Sun simulator"), Setup::kFlash);
  EXPECT_EQ(FindSetup("LIV of the night shift"), Setup::kLaboratory);
  EXPECT_EQ(FindSetup("Outdoor measurement"), Setup::kOutdoor);
  EXPECT_EQ(FindSetup("Smart I-V curve diagnosis"), Setup::kInverter);
  EXPECT_EQ(FindSetup("Flashlight 3, delivery of aaab"), Setup::kUnknown);
  EXPECT_EQ(FindSetup("inverter: SMA"), Setup::kUnknown);  // of the plant, not of the sweep
}

}  // namespace
}  // namespace lyrefit
