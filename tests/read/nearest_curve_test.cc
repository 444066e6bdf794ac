#include "lyrefit/read/nearest_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/base/constants.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

IvCurve At(const std::string& id, double irradiance_W_m2, double temperature_C) {
  IvCurve curve;
  curve.name = id;
  curve.conditions.irradiance_W_m2 = irradiance_W_m2;
  curve.conditions.cell_temperature_K = temperature_C + kZeroCelsius_K;
  return curve;
}

CurveSet Four() {
  CurveSet set;
  set.name = "roof";
  set.source = "roof.csv";
  set.curves = {At("a", 987.25, 24.6), At("b", 1000, 27), At("c", 600, 25), At("d", 1000, 60)};
  return set;
}

TEST(NearestCurve, CountsAKelvinAsMuchAsTenWatts) {
  // Distances: a differs by 12.75 W/m2 and 0.4 K, 0.0134; b by 2 K, 0.02.
  EXPECT_EQ(*NearestCurve(Four(), 1000, 25), 0U);
  EXPECT_EQ(*NearestCurve(Four(), 1000, 26.6), 1U);
  EXPECT_EQ(*NearestCurve(Four(), 200, 25), 2U);
  EXPECT_EQ(*NearestCurve(Four(), 1000, 44), 3U) << "16 K from d, 17 K from b";
  EXPECT_EQ(*NearestCurve(Four(), 800, 31), 0U) << "a: 0.198 away, b: 0.204, c: 0.209";
}

TEST(NearestCurve, TakesTheFirstOfTwoEquallyFar) {
  CurveSet set = Four();
  set.curves[2].conditions = set.curves[1].conditions;
  EXPECT_EQ(*NearestCurve(set, 1000, 27), 1U);
}

TEST(NearestCurve, LeavesOutCurvesWhoseConditionsNobodyStated) {
  CurveSet set = Four();
  set.curves[0].irradiance_known = false;
  EXPECT_EQ(*NearestCurve(set, 987.25, 24.6), 1U);
  set.curves[1].temperature_known = false;
  EXPECT_EQ(*NearestCurve(set, 800, 25), 2U);
  for (IvCurve& curve : set.curves) curve.temperature_known = false;
  const auto none = NearestCurve(set, 1000, 25);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().ToString(), HasSubstr("roof.csv: no curve of the set"));
}

TEST(NearestCurve, RefusesWhatIsNoCondition) {
  EXPECT_FALSE(NearestCurve(Four(), -1, 25));
  EXPECT_FALSE(NearestCurve(Four(), 1000, -300));
  EXPECT_FALSE(NearestCurve(Four(), std::stod("nan"), 25));
}

TEST(FindCurve, GoesByTheIdAndNamesTheOthers) {
  EXPECT_EQ(*FindCurve(Four(), "c"), 2U);
  EXPECT_THAT(MessageOf(FindCurve(Four(), "z")), HasSubstr("'z': the 4 curves are a, b, c, d"));
}

TEST(LabelInSet, NamesSetCurveAndItsOwnConditions) {
  CurveSet set = Four();
  EXPECT_EQ(LabelInSet(set, set.curves[0]), "roof/a (987.25 W/m2, 24.6 C)");
  set.curves[0].temperature_known = false;
  EXPECT_EQ(LabelInSet(set, set.curves[0]), "roof/a (987.25 W/m2, ? C)");
}

}  // namespace
}  // namespace lyrefit
