#include "lyrefit/model/curve_shape.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lyrefit {
namespace {

// A current step from 1 to 0.6 at 0.3 V, half of the open-circuit voltage.
Readings Stepped(int points) {
  Readings readings;
  readings.pivot_voltage = 0.6;
  for (int k = 0; k < points; ++k) {
    Reading r;
    r.voltage = 0.6 * k / (points - 1);
    r.current = r.voltage < 0.3 ? 1 : 0.6;
    readings.points.push_back(r);
  }
  return readings;
}

TEST(CurveShape, KeepsAStepWhereItIs) {
  const CurveShape shape = ShapeOf(Stepped(61));
  EXPECT_DOUBLE_EQ(shape.open_circuit, 0.6);
  EXPECT_DOUBLE_EQ(shape.At(0), 1);
  EXPECT_DOUBLE_EQ(shape.At(0.48), 1);
  EXPECT_DOUBLE_EQ(shape.At(0.52), 0.6);
  EXPECT_DOUBLE_EQ(shape.At(1), 0.6);
}

TEST(CurveShape, PassesOverASingleWrongReading) {
  Readings readings = Stepped(61);
  readings.points[10].current = 3;
  EXPECT_DOUBLE_EQ(ShapeOf(readings).At(1.0 / 6), 1);
}

TEST(CurveShape, TakesSweepsOfBothDirectionsTogether) {
  Readings readings = Stepped(61);
  std::vector<Reading> back = readings.points;
  std::reverse(back.begin(), back.end());
  for (Reading& r : back) r.segment = 1;
  readings.points.insert(readings.points.end(), back.begin(), back.end());
  const CurveShape shape = ShapeOf(readings);
  EXPECT_DOUBLE_EQ(shape.At(0.3), 1);
  EXPECT_DOUBLE_EQ(shape.At(0.7), 0.6);
}

TEST(CurveShape, OfDarkReadingsThereIsNone) {
  Readings readings = Stepped(11);
  for (Reading& r : readings.points) r.dark = true;
  EXPECT_TRUE(ShapeOf(readings).current.empty());
  EXPECT_EQ(ShapeOf(readings).At(0.5), 0);
}

TEST(Stairs, HaveAPlateauBeforeEveryStep) {
  const Stairs stairs = StairsOf(ShapeOf(Stepped(61)));
  ASSERT_EQ(stairs.plateaus.size(), 1U);  // no step follows the second
  EXPECT_DOUBLE_EQ(stairs.plateaus[0].current, 1);
  ASSERT_EQ(stairs.steps.size(), 1U);
  EXPECT_NEAR(stairs.steps[0], 0.5, 0.03);
  Readings knee = Stepped(61);
  for (Reading& r : knee.points) {
    if (r.voltage > 0.54) r.current = 10 * (0.6 - r.voltage);
  }
  const Stairs two = StairsOf(ShapeOf(knee));
  ASSERT_EQ(two.plateaus.size(), 2U);
  EXPECT_DOUBLE_EQ(two.plateaus[1].current, 0.6);
  EXPECT_EQ(two.steps.size(), 2U);
}

TEST(Stairs, AreNoneWithoutReadings) { EXPECT_TRUE(StairsOf(CurveShape()).plateaus.empty()); }

}  // namespace
}  // namespace lyrefit
