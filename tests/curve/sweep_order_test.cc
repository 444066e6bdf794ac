#include "lyrefit/curve/sweep_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(FindTurnsTest, CountsMonotoneStretches) {
  EXPECT_THAT(FindTurns({0, 1, 2, 3}), ElementsAre(0));
  EXPECT_THAT(FindTurns({3, 2, 1, 0}), ElementsAre(0));
  EXPECT_THAT(FindTurns({0, 1, 2, 3, 2, 1, 0}), ElementsAre(0, 4));
  EXPECT_THAT(FindTurns({0, 2, 4, 2, 0, 2, 4}), ElementsAre(0, 3, 5));
  EXPECT_THAT(FindTurns({1, 1, 1}), ElementsAre(0));
}

TEST(FindTurnsTest, IgnoresJitter) {
  EXPECT_THAT(FindTurns({0, 1, 0.9, 2, 1.9, 3, 4, 3.9, 5}), ElementsAre(0));
  EXPECT_THAT(FindTurns({0, 2, 1.9, 4, 4.1, 4, 2, 2.1, 0}), ElementsAre(0, 5));
}

CurveSet SetOf(std::vector<double> voltage) {
  IvCurve curve;
  curve.name = "taken";
  curve.voltage_V = std::move(voltage);
  for (const double v : curve.voltage_V) curve.current_A.push_back(100 + v);
  curve.time_s.assign(curve.voltage_V.size(), 1.0);
  CurveSet set;
  set.curves = {curve};
  return set;
}

TEST(InOrderTest, SortsWhatComesInNoOrder) {
  std::vector<std::string> warnings;
  const CurveSet sorted = InOrder(SetOf({5, 1, 4, 0, 3, 2, 6}), &warnings);
  const IvCurve& curve = sorted.curves.front();
  EXPECT_THAT(curve.voltage_V, ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(curve.current_A, ElementsAre(100, 101, 102, 103, 104, 105, 106));
  EXPECT_THAT(curve.time_s, IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("taken: the readings are in no order of voltage")));
}

TEST(InOrderTest, LeavesSweepsAsTheyAre) {
  std::vector<std::string> warnings;
  const std::vector<double> up_and_down = {0, 1, 2, 3, 4, 5, 5, 4, 3, 2, 1, 0};
  EXPECT_EQ(InOrder(SetOf(up_and_down), &warnings).curves.front().voltage_V, up_and_down);
  EXPECT_THAT(warnings, IsEmpty());
}

}  // namespace
}  // namespace lyrefit
