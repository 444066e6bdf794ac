#include "lyrefit/read/key_point_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "error_of.h"
#include "lyrefit/read/read_table.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Expected<CurveSet> Read(const std::string& text) {
  return ReadKeyPoints({text, ""}, "matrix.csv", "", {});
}

TEST(ReadKeyPointsTest, EachConditionIsACurveOfThreeReadings) {
  const std::string text =
      "Number of cells: 60\nG [W/m2];Tc [C];Isc [mA];Voc [V];Imp [mA];Vmp [V];FF\n"
      "200;25;1750,0;34;1600;28;0,7\n1000;25;8500;36;8000;30;0,7\n";
  ASSERT_TRUE(HoldsKeyPoints(text, "f"));
  const auto set = Read(text);
  ASSERT_TRUE(set) << set.error().ToString();
  ASSERT_EQ(set->curves.size(), 2U);
  const IvCurve& dim = set->curves[0];
  EXPECT_EQ(dim.name, "200 W/m2, 25 C");
  EXPECT_THAT(dim.voltage_V, ElementsAre(0, 28, 34));
  EXPECT_THAT(dim.current_A, ElementsAre(1.75, 1.6, 0));
  EXPECT_EQ(dim.conditions.cells_in_series, 60);
  EXPECT_EQ(dim.conditions.irradiance_W_m2, 200);
}

TEST(ReadKeyPointsTest, MissingPointsLeaveTheirReadingOut) {
  const auto set = Read(
      "irradiance,temperature,i_sc,v_oc,i_mp,v_mp\n200,25,1.7,34,,28\n1000,25,8.5,36,8,30\n"
      "1100,25,9.4,,,\n");
  ASSERT_TRUE(set) << set.error().ToString();
  ASSERT_EQ(set->curves.size(), 2U);
  EXPECT_THAT(set->curves[0].voltage_V, ElementsAre(0, 34));
  ASSERT_EQ(set->rejected.size(), 1U);
  EXPECT_THAT(set->rejected[0].error.ToString(), HasSubstr("matrix.csv:4: expected at least two"));
}

TEST(ReadKeyPointsTest, ThePowerStandsForACurrentOrAVoltage) {
  const auto set = Read(
      "irradiance,temperature,i_sc,v_oc,v_mp,p_mp_mW\n200,25,1.7,34,28,44800\n"
      "1000,25,8.5,36,,240000\n");
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_THAT(set->curves[0].voltage_V, ElementsAre(0, 28, 34));
  EXPECT_DOUBLE_EQ(set->curves[0].key_points->max_power_current_A, 1.6);
  EXPECT_THAT(set->curves[1].voltage_V, ElementsAre(0, 36));
  EXPECT_DOUBLE_EQ(set->curves[1].key_points->max_power_W, 240);
  EXPECT_TRUE(std::isnan(set->curves[1].key_points->max_power_voltage_V));
}

TEST(ReadKeyPointsTest, APowerOfOtherPointsIsRefused) {
  const auto set = Read(
      "irradiance,temperature,i_sc,v_oc,i_mp,v_mp,p_mp\n200,25,1.7,34,1.6,28,44.8\n"
      "1000,25,8.5,36,8,30,200\n");
  EXPECT_THAT(MessageOf(set), HasSubstr("expected Pmp = Imp Vmp = 240 W, found 200 W"));
}

TEST(ReadKeyPointsTest, AWideTableHasRowsOfLightAndColumnsOfTemperature) {
  const auto set = Read(
      "Isc (A)\nG,25 C,50 C\n200,1.7,\n1000,8.5,8.6\nVoc (V)\nG,25 C,50 C\n200,34,\n"
      "1000,36,33\nImp (A)\nG,25 C,50 C\n1000,8,8.1\nVmp (V)\nG,25 C,50 C\n1000,30,27\n");
  ASSERT_TRUE(set) << set.error().ToString();
  ASSERT_EQ(set->curves.size(), 3U);
  EXPECT_THAT(set->curves[0].voltage_V, ElementsAre(0, 34));
  EXPECT_EQ(set->curves[2].name, "1000 W/m2, 50 C");
  EXPECT_THAT(set->curves[2].current_A, ElementsAre(8.6, 8.1, 0));
}

TEST(ReadKeyPointsTest, AWrongFieldIsRefusedWithItsPlace) {
  const auto set = Read("irradiance,temperature,i_sc,v_oc,i_mp,v_mp\n200,25,1.7,x34,1.6,28\n");
  ExpectErrorAt(set, "matrix.csv", 2, 12, "expected a number in column v_oc, found 'x34'");
}

TEST(HoldsKeyPointsTest, ATableOfThemIsNoSunsVocTrace) {
  const std::string text =
      "Irradiance (W/m2),Temperature (C),Isc (A),Voc (V),Impp (A),Vmpp (V)\n"
      "200,25,1.7,36,1.6,31\n1000,25,8.5,38,7.9,31\n";
  ReadOptions first;
  first.column = "1";
  EXPECT_FALSE(ReadTable(text, "f", first));
  EXPECT_TRUE(HoldsKeyPoints(text, "f"));
}

TEST(HoldsKeyPointsTest, OneConditionOrACurveIsNone) {
  for (const char* text :
       {"V,I\n0,1\n1,0\n", "i_sc,v_oc,i_mp,v_mp\n8.5,36,8,30\n8.6,36,8,30\n",
        "irradiance,temperature,i_sc,v_oc,i_mp,v_mp\n1000,25,8.5,36,8,30\n", ""}) {
    EXPECT_FALSE(HoldsKeyPoints(text, "f")) << text;
  }
}

}  // namespace
}  // namespace lyrefit
