#include "lyrefit/curve/sweep_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lyrefit {
namespace {

// An ideal cell with a shunt, in generator sign.
IvCurve MakeCell(double photocurrent_A, double from_V, double to_V, int points = 40) {
  IvCurve curve;
  for (int i = 0; i < points; ++i) {
    const double voltage = from_V + (to_V - from_V) * i / (points - 1);
    curve.voltage_V.push_back(voltage);
    curve.current_A.push_back(photocurrent_A - 1e-9 * std::expm1(voltage / 0.03) - voltage / 100);
  }
  return curve;
}

std::vector<double> Negated(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

TEST(DetectCurrentSignTest, TellsBothSignsApartOnEveryPartOfACurve) {
  const struct {
    const char* name;
    IvCurve curve;
  } kCases[] = {
      {"whole light curve", MakeCell(1, 0, 0.63)},
      {"falling voltage", MakeCell(1, 0.63, 0)},
      {"with reverse bias", MakeCell(1, -0.5, 0.63)},
      {"far beyond open circuit", MakeCell(1, 0, 0.72)},
      {"flat part only", MakeCell(1, 0, 0.4)},
      {"without short circuit", MakeCell(1, 0.45, 0.62)},
      {"around open circuit", MakeCell(1, 0.6, 0.64)},
      {"beyond open circuit only", MakeCell(1, 0.63, 0.7)},
      {"reverse bias only", MakeCell(1, -2, -0.5)},
      {"dark", MakeCell(0, 0, 0.65)},
      {"dark with reverse bias", MakeCell(0, -5, 0.65)},
      {"dark reverse bias only", MakeCell(0, -5, -0.1)},
      {"dark forward part only", MakeCell(0, 0.5, 0.65)},
      {"two points", MakeCell(1, 0, 0.6, 2)},
      {"three points", MakeCell(1, 0, 0.63, 3)},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.name);
    const std::vector<double>& current = c.curve.current_A;
    EXPECT_EQ(DetectCurrentSign(c.curve.voltage_V, current), CurrentSign::kGenerator);
    EXPECT_EQ(DetectCurrentSign(c.curve.voltage_V, Negated(current)), CurrentSign::kLoad);
  }
}

TEST(DetectCurrentSignTest, DriftOnTheFlatPartDoesNotTurnTheSign) {
  const std::vector<double> voltage = {0, 1, 2, 3, 4, 5, 6};
  const std::vector<double> rising = {2.98, 2.99, 3.0, 3.01, 3.02, 3.03, 3.04};
  EXPECT_EQ(DetectCurrentSign(voltage, rising), CurrentSign::kGenerator);
  EXPECT_EQ(DetectCurrentSign(voltage, Negated(rising)), CurrentSign::kLoad);
}

TEST(DetectCurrentSignTest, OneOutlierAtZeroVoltDoesNotDecide) {
  IvCurve curve = MakeCell(1, 0, 0.63);
  curve.current_A[0] = -5;
  EXPECT_EQ(DetectCurrentSign(curve.voltage_V, curve.current_A), CurrentSign::kGenerator);
}

TEST(DetectCurrentSignTest, TurnedVoltageIsLeftUnclear) {
  const IvCurve curve = MakeCell(1, 0, 0.63);
  EXPECT_EQ(DetectCurrentSign(Negated(curve.voltage_V), curve.current_A), CurrentSign::kUnclear);
  EXPECT_EQ(DetectCurrentSign(Negated(curve.voltage_V), Negated(curve.current_A)),
            CurrentSign::kUnclear);
}

TEST(DetectCurrentSignTest, NothingToSeeIsGeneratorSign) {
  EXPECT_EQ(DetectCurrentSign({}, {}), CurrentSign::kGenerator);
  EXPECT_EQ(DetectCurrentSign({0, 1}, {0, 0}), CurrentSign::kGenerator);
  EXPECT_EQ(DetectCurrentSign({1, 1}, {2, 2}), CurrentSign::kGenerator);
}

TEST(TurnLoadSignTest, TurnsCurrentsAndSaysSo) {
  const IvCurve generator = MakeCell(1, 0, 0.63);
  IvCurve load = generator;
  load.current_A = Negated(load.current_A);
  TurnLoadSign(&load);
  EXPECT_EQ(load.current_A, generator.current_A);
  EXPECT_EQ(load.voltage_V, generator.voltage_V);
  EXPECT_THAT(SentencesOf(load.assumptions),
              ::testing::ElementsAre(::testing::HasSubstr("load sign")));
}

TEST(TurnLoadSignTest, LeavesUnclearCurvesAsWrittenAndSaysSo) {
  IvCurve curve = MakeCell(1, 0, 0.63);
  curve.voltage_V = Negated(curve.voltage_V);
  const IvCurve before = curve;
  TurnLoadSign(&curve);
  EXPECT_EQ(curve.current_A, before.current_A);
  EXPECT_EQ(curve.voltage_V, before.voltage_V);
  EXPECT_THAT(SentencesOf(curve.assumptions),
              ::testing::ElementsAre(::testing::HasSubstr("left as written")));
}

TEST(TurnLoadSignTest, ZeroStaysPositiveZero) {
  IvCurve curve;
  curve.voltage_V = {0, 0.5, 0.6};
  curve.current_A = {-1, -0.8, 0};
  TurnLoadSign(&curve);
  EXPECT_FALSE(std::signbit(curve.current_A[2]));
}

}  // namespace
}  // namespace lyrefit
