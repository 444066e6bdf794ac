#include "lyrefit/read/condition_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/read/read_curve.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kStatedHead[] =
    "Irradiance (W/m2),912\nCell temperature (C),49.8\nNumber of cells,60\nBypass diodes,3\n"
    "Technology,mono-Si\nV,I\n0,8\n10,7.9\n20,7.8\n30,5\n36,0\n";

IvCurve Stated() {
  const auto curve = ReadCurveText(kStatedHead, "string.csv", {});
  EXPECT_TRUE(curve) << curve.error().ToString();
  return *curve;
}

ConditionOptions GivenAll() {
  ConditionOptions given;
  given.temperature_C = 20;
  given.irradiance_W_m2 = 1000;
  given.cells = 1200;
  given.bypass_diodes = 60;
  given.technology = "HJT";
  return given;
}

TEST(ApplyConditionsTest, SaysWhatItReplacesAndWhereThatStood) {
  IvCurve curve = Stated();
  ASSERT_TRUE(ApplyConditions(GivenAll(), &curve));
  EXPECT_NEAR(curve.conditions.cell_temperature_K, 293.15, 1e-9);
  EXPECT_EQ(curve.conditions.irradiance_W_m2, 1000);
  EXPECT_EQ(curve.conditions.cells_in_series, 1200);
  EXPECT_EQ(curve.notes.bypass_diodes, 60);
  EXPECT_EQ(curve.notes.technology, "HJT");
  const std::vector<std::string> said = SentencesOf(curve.assumptions);
  for (const char* sentence :
       {"20 C given, instead of 49.8 C in line 2", "1000 W/m2 given, instead of 912 W/m2 in line 1",
        "1200 cells given, instead of 60 cells in line 3",
        "60 bypass diodes given, instead of 3 bypass diodes in line 4",
        "HJT given, instead of mono-Si in line 5"}) {
    EXPECT_THAT(said, Contains(sentence));
  }
  EXPECT_THAT(said, Not(Contains(HasSubstr("taken from line"))));
}

TEST(ApplyConditionsTest, FillsOnlyWhatIsNotStatedUnlessItReplaces) {
  ConditionOptions given = GivenAll();
  given.replaces = false;
  IvCurve curve = Stated();
  ASSERT_TRUE(ApplyConditions(given, &curve));
  EXPECT_NEAR(curve.conditions.cell_temperature_K, 322.95, 1e-9);
  EXPECT_EQ(curve.conditions.cells_in_series, 60);
  EXPECT_EQ(curve.notes.bypass_diodes, 3);
  EXPECT_EQ(curve.notes.technology, "mono-Si");
  EXPECT_THAT(SentencesOf(curve.assumptions),
              Contains("49.8 C in line 2 counts, not the 20 C given (--override)"));
  const auto bare = ReadCurveText("V,I\n0,8\n10,7.9\n20,7.8\n30,5\n36,0\n", "bare.csv", {});
  ASSERT_TRUE(bare) << bare.error().ToString();
  IvCurve filled = *bare;
  ASSERT_TRUE(ApplyConditions(given, &filled));
  EXPECT_NEAR(filled.conditions.cell_temperature_K, 293.15, 1e-9);
  EXPECT_TRUE(filled.temperature_known && filled.irradiance_known && filled.cells_known);
  EXPECT_EQ(filled.notes.bypass_diodes, 60);
  EXPECT_THAT(SentencesOf(filled.assumptions),
              Not(Contains(::testing::AnyOf(HasSubstr("given"), HasSubstr("assumed")))));
}

TEST(ApplyConditionsTest, NamesKeysAndColumns) {
  const TempFolder folder;
  const std::string path =
      folder.Write("a.csv", "V,I,G\n0,8,900\n10,7.9,900\n20,7,900\n30,0,900\n");
  folder.Write("a.json", R"({"cell_temperature_C": 49.8, "bypass_diodes": 3})");
  const auto read = ReadCurve(path);
  ASSERT_TRUE(read) << read.error().ToString();
  IvCurve curve = *read;
  ASSERT_TRUE(ApplyConditions(GivenAll(), &curve));
  EXPECT_THAT(
      SentencesOf(curve.assumptions),
      AllOf(Contains("20 C given, instead of 49.8 C in \"cell_temperature_C\" of a.json"),
            Contains("60 bypass diodes given, instead of 3 bypass diodes in \"bypass_diodes\" of "
                     "a.json"),
            Contains("1000 W/m2 given, instead of 900 W/m2 in the column of the irradiance")));
}

TEST(ApplyConditionsTest, SaysNothingOfEqualValuesAndOfValuesThatNobodyStated) {
  ConditionOptions given;
  given.temperature_C = 49.8;
  given.cells = 60;
  IvCurve curve = Stated();
  ASSERT_TRUE(ApplyConditions(given, &curve));
  EXPECT_THAT(SentencesOf(curve.assumptions), Not(Contains(HasSubstr("given"))));
  IvCurve made;  // in memory: its conditions are of no file
  ASSERT_TRUE(ApplyConditions(GivenAll(), &made));
  EXPECT_TRUE(made.assumptions.empty());
}

TEST(ApplyConditionsTest, NamesTheCurvesOfASet) {
  CurveSet set;
  set.curves = {Stated(), Stated()};
  set.curves[0].name = "up";
  set.curves[1].name = "down";
  ConditionOptions given;
  given.temperature_C = 20;
  ASSERT_TRUE(ApplyConditions(given, &set));
  EXPECT_THAT(SentencesOf(set.curves[1].assumptions),
              Contains("down: 20 C given, instead of 49.8 C in line 2"));
}

TEST(ApplyConditionsTest, RefusesFewerDiodesThanNone) {
  ConditionOptions given;
  given.bypass_diodes = -1;
  IvCurve curve = Stated();
  EXPECT_EQ(MessageOf(ApplyConditions(given, &curve)),
            "bypass-diodes: expected at least 0 bypass diodes, found -1");
}

}  // namespace
}  // namespace lyrefit
