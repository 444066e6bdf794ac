#include "lyrefit/curve/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A module of 60 cells at 800 W/m2 with this Isc.
IvCurve ModuleWith(double isc_A, int strings = 1) {
  IvCurve curve;
  curve.conditions.cells_in_series = 60;
  curve.conditions.strings_in_parallel = strings;
  curve.conditions.irradiance_W_m2 = 800;
  curve.voltage_V = {0, 10, 20, 30, 36};
  for (const double part : {1.0, 0.99, 0.98, 0.8, 0.0}) curve.current_A.push_back(part * isc_A);
  return curve;
}

std::string Said(const IvCurve& curve) { return PlausibilityProblem(curve).value_or(""); }

TEST(Plausibility, ModulesAndCellsHaveNoFindings) {
  for (const double isc_A : {0.3, 1.0, 9.0, 20.0}) {
    EXPECT_THAT(CheckPlausibility(ModuleWith(isc_A)), IsEmpty()) << isc_A;
  }
  EXPECT_THAT(CheckPlausibility(SyntheticModule()), IsEmpty());
  EXPECT_THAT(CheckPlausibility(SyntheticModule(1, 1, 0.3)), IsEmpty());
  EXPECT_THAT(CheckPlausibility(SyntheticCell()), IsEmpty());
  EXPECT_THAT(CheckPlausibility(SyntheticCell(0)), IsEmpty()) << "dark";
}

TEST(Plausibility, DoubtsACurrentThatNoCellGives) {
  EXPECT_THAT(Said(ModuleWith(9000)), HasSubstr("with 1 string in parallel"));
  EXPECT_THAT(Said(ModuleWith(9000)), HasSubstr("mA?"));
  EXPECT_THAT(Said(ModuleWith(250, 2)), HasSubstr("2 strings"));
  EXPECT_EQ(Said(ModuleWith(250, 20)), "");
  const std::vector<ReadingFinding> found = CheckReadings(ModuleWith(9000));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "current");
  EXPECT_FALSE(found[0].refuse);
}

TEST(Plausibility, DoubtsACurrentThatTheStatedLightDoesNotGive) {
  IvCurve curve = ModuleWith(8);
  for (const double light_W_m2 : {0.0, 5.0}) {
    curve.conditions.irradiance_W_m2 = light_W_m2;
    EXPECT_THAT(Said(curve), HasSubstr("which of the two is right")) << light_W_m2;
  }
  curve.conditions.irradiance_W_m2 = 50;
  EXPECT_THAT(Said(curve), HasSubstr("less light than there was"));
  curve.irradiance_known = false;
  EXPECT_EQ(Said(curve), "") << "nobody stated it";
  curve = ModuleWith(0.02);
  curve.conditions.irradiance_W_m2 = 5;
  EXPECT_EQ(Said(curve), "") << "dusk";
  curve = ModuleWith(3000);
  curve.conditions.irradiance_W_m2 = 4e5;
  EXPECT_EQ(Said(curve), "") << "a concentrator";
}

TEST(Plausibility, DoubtsAModuleWithTheCurrentOfASensor) {
  EXPECT_THAT(Said(ModuleWith(0.008)), HasSubstr("less than a module of 60 cells gives"));
  IvCurve curve = ModuleWith(0.008);
  curve.conditions.cells_in_series = 10;
  EXPECT_EQ(Said(curve), "") << "a mini-module";
  curve = ModuleWith(0.008);
  curve.cells_known = false;
  EXPECT_EQ(Said(curve), "");
  curve = ModuleWith(0.0008);
  curve.conditions.irradiance_W_m2 = 40;
  EXPECT_EQ(Said(curve), "") << "dusk";
  curve = ModuleWith(0.008);
  curve.irradiance_known = false;
  EXPECT_EQ(Said(curve), "") << "nobody stated the light";
}

TEST(Plausibility, DoubtsACurrentDensityBeyondSunlight) {
  IvCurve cell = SyntheticCell();  // 0.15 A at 1000 W/m2
  cell.notes.area_cm2 = 4;
  EXPECT_EQ(Said(cell), "");
  cell.notes.area_cm2 = 0.4;
  EXPECT_THAT(Said(cell), HasSubstr("375 mA/cm2"));
}

TEST(Plausibility, DoubtsAFillFactorOfNoDiode) {
  IvCurve curve;
  curve.cells_known = false;
  curve.voltage_V = {0, 10, 20, 35, 36, 37};
  curve.current_A = {8, 8, 8, 8, 8, -1};
  EXPECT_THAT(Said(curve), HasSubstr("fill factor is 0.9"));
  curve.voltage_V = {0, 1, 2, 3, 4, 30};
  curve.current_A = {8, 4, 2, 1, 0.4, -0.01};
  EXPECT_THAT(Said(curve), HasSubstr("no power in it"));
}

TEST(Plausibility, DoubtsATemperatureThatSunGivesNoModule) {
  IvCurve curve = ModuleWith(9);
  curve.conditions.cell_temperature_K = 273.15 + 88;
  EXPECT_EQ(Said(curve), "");
  curve.conditions.cell_temperature_K = 273.15 + 113;
  EXPECT_THAT(Said(curve), HasSubstr("113 C is more than sun gives a module: 45 C in degrees"));
  IvCurve cell = SyntheticCell();  // on a hot plate
  cell.conditions.cell_temperature_K = 273.15 + 150;
  EXPECT_EQ(Said(cell), "");
}

TEST(Plausibility, DoubtsAPowerFarFromTheRating) {
  const IvCurve curve = ModuleWith(9);  // 216 W
  EXPECT_FALSE(PlausibilityProblem(curve));
  EXPECT_FALSE(PlausibilityProblem(curve, 250));
  EXPECT_FALSE(PlausibilityProblem(curve, 2500)) << "a string in deep shade";
  EXPECT_THAT(PlausibilityProblem(curve, 70).value_or(""),
              HasSubstr("times the rated power of 70 W"));
  EXPECT_THAT(PlausibilityProblem(ModuleWith(0.009), 300).value_or(""),
              HasSubstr("times the rated power of 300 W"));
  IvCurve dusk = ModuleWith(0.09);
  dusk.conditions.irradiance_W_m2 = 10;
  EXPECT_FALSE(PlausibilityProblem(dusk, 300));
}

}  // namespace
}  // namespace lyrefit
