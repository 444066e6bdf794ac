#include "lyrefit/read/settle_conditions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/curve/assumption.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(SettleConditionsTest, SaysEverythingItHasToAssume) {
  IvCurve curve;
  SettleConditions({}, &curve);
  EXPECT_EQ(curve.conditions.cells_in_series, 1);
  EXPECT_EQ(curve.conditions.cell_temperature_K, 298.15);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 1000);
  EXPECT_THAT(SentencesOf(curve.assumptions),
              ElementsAre(kCellsAssumed, kTemperatureAssumed, kIrradianceAssumed));
  EXPECT_FALSE(curve.temperature_known);
  EXPECT_FALSE(curve.irradiance_known);
}

TEST(SettleConditionsTest, TakesTheSidecarAsItIs) {
  IvCurve curve;
  curve.name = "file";
  Sidecar sidecar;
  sidecar.name = "module";
  sidecar.cells_in_series = 36;
  sidecar.strings_in_parallel = 2;
  sidecar.temperature_C = 45;
  sidecar.irradiance_W_m2 = 0;
  sidecar.notes.technology = "CdTe";
  SettleConditions(sidecar, &curve);
  EXPECT_EQ(curve.name, "module");
  EXPECT_EQ(curve.conditions.cells_in_series, 36);
  EXPECT_EQ(curve.conditions.strings_in_parallel, 2);
  EXPECT_EQ(curve.conditions.cell_temperature_K, 318.15);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 0);
  EXPECT_EQ(curve.notes.technology, "CdTe");
  EXPECT_THAT(SentencesOf(curve.assumptions), IsEmpty());
}

TEST(SettleConditionsTest, ColumnsStandInForAMissingSidecar) {
  IvCurve curve;
  curve.temperature_C = {30, 30};
  curve.irradiance_W_m2 = {799, 801};
  SettleConditions({}, &curve);
  EXPECT_EQ(curve.conditions.cell_temperature_K, 303.15);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 800);
  EXPECT_THAT(SentencesOf(curve.assumptions), ElementsAre(kCellsAssumed));
}

TEST(SettleConditionsTest, NightIsDarkAndSaidOnce) {
  IvCurve curve;
  curve.irradiance_W_m2 = {-2, -3, 1};
  SettleConditions({}, &curve);
  EXPECT_THAT(curve.irradiance_W_m2, ElementsAre(0, 0, 1));
  EXPECT_THAT(SentencesOf(curve.assumptions),
              testing::Contains("irradiance below zero in 2 of 3 readings (down to -3 W/m2), as a "
                                "sensor shows it at night: taken as 0"));
}

TEST(SettleConditionsTest, NoIrradianceFollowsFromLux) {
  IvCurve curve;
  Sidecar sidecar;
  sidecar.notes.illuminance_lux = 250;
  SettleConditions(sidecar, &curve);
  EXPECT_FALSE(curve.irradiance_known);
  EXPECT_THAT(SentencesOf(curve.assumptions),
              testing::Contains(testing::HasSubstr("no W/m2 follow from 250 lux")));
}

TEST(SettleConditionsTest, TheLightOfARoomStatesNoIrradiance) {
  IvCurve curve;
  Sidecar sidecar;
  sidecar.light = "line 2 'Room light'";
  SettleConditions(sidecar, &curve);
  EXPECT_FALSE(curve.irradiance_known);
  EXPECT_THAT(
      SentencesOf(curve.assumptions),
      testing::Contains(testing::HasSubstr("line 2 'Room light' states a light whose W/m2")));
}

TEST(SettleConditionsTest, AsksForTheUnitOfADensityThatFitsTwo) {
  ReadOptions options;
  options.area_cm2 = 0.1;
  IvCurve curve;
  curve.voltage_V = {0, 0.5};
  curve.current_A = {21e-6, 0};  // 0.021 in the file, taken as mA/cm2
  curve.current_unit_known = false;
  const auto settled = SettleArea(options, {}, &curve);
  ASSERT_FALSE(settled);
  EXPECT_THAT(settled.error().message, testing::HasSubstr("0.021"));
  EXPECT_THAT(settled.error().message, testing::HasSubstr("--current-unit A/cm2"));
  Sidecar room;
  room.light = "line 2 'Room light'";
  IvCurve dim = curve, bright = curve, named = curve;
  EXPECT_TRUE(SettleArea(options, room, &dim));
  bright.current_A[0] = 21e-3;
  EXPECT_TRUE(SettleArea(options, {}, &bright));
  named.current_unit_known = true;
  EXPECT_TRUE(SettleArea(options, {}, &named));
}

Sidecar StandardCell() {
  Sidecar sidecar;
  sidecar.cells_in_series = 1;
  sidecar.temperature_C = 25;
  sidecar.irradiance_W_m2 = 1000;
  return sidecar;
}

TEST(SettleConditionsTest, ColumnThatAgreesLeavesTheRoundFigure) {
  IvCurve curve;
  curve.temperature_C = {25.03, 25.07};
  curve.irradiance_W_m2 = {1003, 1004};
  SettleConditions(StandardCell(), &curve);
  EXPECT_EQ(curve.conditions.cell_temperature_K, 298.15);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 1000);
  EXPECT_THAT(SentencesOf(curve.assumptions), IsEmpty());
}

TEST(SettleConditionsTest, ColumnThatDiffersCountsAndIsSaid) {
  IvCurve curve;
  curve.temperature_C = {55, 55};
  curve.irradiance_W_m2 = {0, 0};
  SettleConditions(StandardCell(), &curve);
  EXPECT_EQ(curve.conditions.cell_temperature_K, 328.15);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 0);
  EXPECT_THAT(SentencesOf(curve.assumptions),
              ElementsAre(HasSubstr("the cell temperature in the table (55 C) differs"),
                          HasSubstr("the irradiance in the table (0 W/m2) differs")));
}

TEST(SettleConditionsTest, ColumnThatVariesIsSaid) {
  IvCurve curve;
  curve.irradiance_W_m2 = {900, 1000};
  SettleConditions({}, &curve);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 950);
  EXPECT_THAT(SentencesOf(curve.assumptions),
              ::testing::Contains(HasSubstr("irradiance varies from 900 to 1000 W/m2")));
}

TEST(SettleConditionsTest, DarkOffsetOfTheSensorIsNoNegativeIrradiance) {
  IvCurve curve;
  curve.irradiance_W_m2 = {-0.4, -0.4};
  SettleConditions({}, &curve);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 0);
}

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(AssumptionTest, IsTakenBackWithAllOthersOfItsKind) {
  std::vector<Assumption> assumptions = {"first",
                                         {"irradiance not given", About::kIrradiance},
                                         "irradiance: a word that stands in a sentence only",
                                         {"another sentence", About::kIrradiance}};
  Forget(About::kCells, &assumptions);
  EXPECT_EQ(assumptions.size(), 4U);
  Forget(About::kIrradiance, &assumptions);
  EXPECT_THAT(SentencesOf(assumptions),
              ElementsAre("first", "irradiance: a word that stands in a sentence only"));
}

TEST(AssumptionTest, EveryWayToTakeAConditionSaysWhatItIsAbout) {
  IvCurve curve;
  curve.temperature_C = {30, 50};
  curve.irradiance_W_m2 = {700, 900};
  TableHead head;
  ReadHeadLine("Irradiance: 500 W/m2", 1, HeadLine::kText, &head);
  ReadHeadLine("Cell temperature: 25 C", 2, HeadLine::kText, &head);
  Sidecar beside;
  beside.irradiance_W_m2 = 1000;
  beside.temperature_C = 20;
  Sidecar stated = MergeHead(beside, head.said);
  const std::vector<Assumption> said = HeadSentences(head);
  stated.assumptions.insert(stated.assumptions.end(), said.begin(), said.end());
  SettleConditions(stated, &curve);
  for (const char* sentence : {"taken from", "in the head", "in the table", "the column of"}) {
    EXPECT_THAT(SentencesOf(curve.assumptions), Contains(HasSubstr(sentence)));
  }
  EXPECT_EQ(curve.assumptions.size(), 9U);  // four from each source, and the cells
  Forget(About::kIrradiance, &curve.assumptions);
  EXPECT_THAT(SentencesOf(curve.assumptions), Not(Contains(HasSubstr("rradiance"))));
  Forget(About::kTemperature, &curve.assumptions);
  EXPECT_THAT(SentencesOf(curve.assumptions), ElementsAre(kCellsAssumed));
  Forget(About::kCells, &curve.assumptions);
  EXPECT_THAT(SentencesOf(curve.assumptions), IsEmpty());
}

}  // namespace
}  // namespace lyrefit
