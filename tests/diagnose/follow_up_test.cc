#include "lyrefit/diagnose/follow_up.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lyrefit/diagnose/choose_base.h"
#include "lyrefit/model/make_readings.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;

Readings ReadingsOf(const std::vector<IvCurve>& curves) {
  std::vector<std::string> warnings;
  return *MakeReadings(SetOf(curves), &warnings);
}

Readings ReadingsOf(const Recipe& recipe) {
  return ReadingsOf(std::vector{SyntheticCurve(recipe)});
}

Recipe Module() {
  Recipe recipe;
  recipe.cells = 60;
  return recipe;
}

std::vector<std::string> Ids(const std::vector<FollowUp>& all) {
  std::vector<std::string> ids;
  for (const FollowUp& follow_up : all) ids.push_back(follow_up.id);
  return ids;
}

const FollowUp& Find(const std::vector<FollowUp>& all, const std::string& id) {
  return *std::find_if(all.begin(), all.end(), [&](const FollowUp& f) { return f.id == id; });
}

TEST(FollowUpMeasurementsTest, FollowTheKindOfData) {
  EXPECT_THAT(
      Ids(FollowUpMeasurements(ReadingsOf(Recipe()))),
      ElementsAre("reverse_sweep", "slower_sweep", "second_light", "dark_curve", "isc_voc"));
  EXPECT_THAT(Ids(FollowUpMeasurements(ReadingsOf(Module()))),
              ElementsAre("reverse_sweep", "slower_sweep", "second_light", "dark_curve",
                          "cover_part", "isc_voc"));
  const Readings lit_and_dark = ReadingsOf({SyntheticCurve({}), SyntheticDarkCurve()});
  EXPECT_THAT(Ids(FollowUpMeasurements(lit_and_dark)),
              ElementsAre("slower_sweep", "second_light", "isc_voc"));
  EXPECT_TRUE(FollowUpMeasurements(ReadingsOf(std::vector{SyntheticDarkCurve()})).empty());
}

TEST(FollowUpMeasurementsTest, TheReverseSweepGoesOnInTime) {
  const Readings readings = ReadingsOf(Recipe());
  const std::vector<FollowUp> all = FollowUpMeasurements(readings);
  const auto& points = Find(all, "reverse_sweep").curves.front().readings.points;
  ASSERT_EQ(points.size(), readings.points.size());
  EXPECT_EQ(points.front().voltage, readings.points.back().voltage);
  EXPECT_EQ(points.front().rate, -readings.points.back().rate);
  EXPECT_DOUBLE_EQ(points.front().x, 0.5);
  EXPECT_DOUBLE_EQ(points.back().x, 1.5);
}

TEST(FollowUpMeasurementsTest, CoveringLeavesTheOtherGroups) {
  const std::vector<FollowUp> all = FollowUpMeasurements(ReadingsOf(Module()));
  const FollowUp& cover = Find(all, "cover_part");
  ASSERT_EQ(cover.curves.size(), 3U);
  for (const PlannedCurve& curve : cover.curves) {
    EXPECT_EQ(curve.readings.traits.cells, 40);
    EXPECT_EQ(SubstringsOf(curve.readings.traits), 2);
  }
  EXPECT_EQ(cover.unknown.size(), 9U);
}

// An effect in time (irr_step) applies to a reverse sweep taken at once after the measurement, but
// not to a later measurement.
TEST(LawOnTest, WhatHappenedInTimeStaysThere) {
  const Readings readings = ReadingsOf(Module());
  Law law = StartingLaw(readings, Model::kSingleDiode);
  law.effects = {FindEffect("irr_step"), FindEffect("shading")};
  std::vector<double> theta = {1, 0, 1.2, 0.015, 0.05, 0.02, 0.1, 0.4, 1.0 / 3, 0.5, 1};
  const std::vector<FollowUp> all = FollowUpMeasurements(readings);
  const CurveLaw at_once = LawOn(Find(all, "reverse_sweep").curves.front(), law, theta);
  EXPECT_EQ(at_once.law.effects, law.effects);
  EXPECT_EQ(at_once.theta, theta);
  const CurveLaw later = LawOn(Find(all, "slower_sweep").curves.front(), law, theta);
  EXPECT_THAT(later.law.effects, ElementsAre(FindEffect("shading")));
  EXPECT_THAT(later.from, ElementsAre(0, 1, 2, 3, 4, 7, 8, 9, 10));
  EXPECT_EQ(later.theta[5], 0.4);
}

TEST(LawOnTest, ACoveredShadeIsGone) {
  const Readings readings = ReadingsOf(Module());
  Law law = StartingLaw(readings, Model::kSingleDiode);
  law.effects = {FindEffect("shading")};
  const std::vector<double> theta = {1, 0, 1.2, 0.015, 0.05, 0.4, 1.0 / 3, 0.5, 1};
  const std::vector<FollowUp> all = FollowUpMeasurements(readings);
  const auto& curves = Find(all, "cover_part").curves;
  EXPECT_TRUE(LawOn(curves[0], law, theta).law.effects.empty());
  EXPECT_NEAR(LawOn(curves[1], law, theta).theta[6], 0.5, 1e-12);
}

TEST(UnderTest, MovesWhatIsUnknown) {
  const std::vector<FollowUp> all = FollowUpMeasurements(ReadingsOf(Module()));
  const FollowUp& light = Find(all, "second_light");
  const PlannedCurve& curve = light.curves.front();
  const Readings moved = Under(curve, {0.1, 2});
  EXPECT_DOUBLE_EQ(moved.points[3].irradiance, 0.55);
  EXPECT_DOUBLE_EQ(moved.points[3].temperature_K, curve.readings.points[3].temperature_K + 2);
  EXPECT_EQ(moved.points[3].voltage, curve.readings.points[3].voltage);
}

}  // namespace
}  // namespace lyrefit
