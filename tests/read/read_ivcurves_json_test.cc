#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve_set.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kTwoCurves[] = R"({
  "Manufacturer": "", "Material": "mono-Si", "cells_in_series": 72,
  "IV Curves": [
    {"Index": 1, "Voltages": ["0.0", "20", "40"], "Currents": ["1.0", "0.9", "0"],
     "Temperature": "298.15", "Irradiance": null, "v_oc": "40"},
    {"Index": 5, "Voltages": [0, 20, 40], "Currents": [-2, -1.9, 0],
     "Temperature": 318.15, "Irradiance": 800, "cells_in_series": "60"}]})";

TEST(ReadIvCurvesJsonTest, ReadsAllCurvesInFileOrder) {
  const TempFolder folder;
  const auto curves = ReadCurveSet(folder.Write("set.json", kTwoCurves));
  ASSERT_TRUE(curves) << curves.error().ToString();
  ASSERT_EQ(curves->curves.size(), 2U);
  const IvCurve& first = curves->curves.front();
  EXPECT_EQ(first.name, "1");
  EXPECT_EQ(first.notes.technology, "mono-Si");
  EXPECT_THAT(first.voltage_V, ElementsAre(0, 20, 40));
  EXPECT_THAT(first.current_A, ElementsAre(1, 0.9, 0));
  EXPECT_EQ(first.conditions.cells_in_series, 72);
  EXPECT_EQ(first.conditions.cell_temperature_K, 298.15);
  EXPECT_THAT(SentencesOf(first.assumptions),
              ElementsAre("irradiance not given: assumed 1000 W/m2"));
  const IvCurve& second = curves->curves.back();
  EXPECT_EQ(second.name, "5");
  EXPECT_EQ(second.conditions.cells_in_series, 60);
  EXPECT_EQ(second.conditions.irradiance_W_m2, 800);
  EXPECT_THAT(second.current_A, ElementsAre(2, 1.9, 0));
  EXPECT_THAT(SentencesOf(second.assumptions), ElementsAre(HasSubstr("load sign")));
}

TEST(ReadIvCurvesJsonTest, ReadCurvePicksByIndex) {
  const TempFolder folder;
  const std::string path = folder.Write("set.json", kTwoCurves);
  ReadOptions options;
  options.curve = 5;
  const auto curve = ReadCurve(path, options);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->name, "set_5");
  options.curve = 2;
  EXPECT_THAT(MessageOf(ReadCurve(path, options)), HasSubstr("curve 2 was asked for"));
  const auto undecided = ReadCurve(path);
  ASSERT_FALSE(undecided);
  EXPECT_THAT(undecided.error().message, HasSubstr("found 2 (1, 5 ...)"));
  EXPECT_THAT(undecided.error().message, HasSubstr("--curve INDEX"));
}

TEST(ReadIvCurvesJsonTest, SingleCurveNeedsNoIndex) {
  const TempFolder folder;
  const auto curve = ReadCurve(folder.Write(
      "one.JSON", R"({"IV Curves": [{"Index": 3, "Voltages": [0, 1], "Currents": [1, 0]}]})"));
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_EQ(curve->assumptions.size(), 3U);
  EXPECT_THAT(SentencesOf(curve->assumptions),
              Contains(HasSubstr("number of cells in series not given")));
}

TEST(ReadIvCurvesJsonTest, ErrorsSayWhereAndWhatWasExpected) {
  const TempFolder folder;
  const struct {
    const char* text;
    const char* phrase;
  } kCases[] = {
      {"[]", "the key \"IV Curves\""},
      {"3", "the key \"IV Curves\""},
      {R"({"cells_in_series": 36})", "the key \"IV Curves\""},
      {R"({"IV Curves": {}})", "a list of curves"},
      {R"({"IV Curves": []})", "a list of curves"},
      {R"({"IV Curves": [7]})", "an object in \"IV Curves\"[0]"},
      {R"({"IV Curves": [{}]})", "a whole number in \"IV Curves\"[0].Index"},
      {R"({"IV Curves": [{"Index": 1.5}]})", "a whole number"},
      {R"({"IV Curves": [{"Index": 1}]})", "a list of numbers in \"IV Curves\"[0].Voltages"},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, [1]], "Currents": [1, 0]}]})",
       "a finite number in \"IV Curves\"[0].Voltages[1]"},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, 1], "Currents": [1, "x"]}]})",
       "\"IV Curves\"[0].Currents[1]"},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, 1], "Currents": [1]}]})",
       "as many Currents as Voltages in \"IV Curves\"[0], found 1 and 2"},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, 0], "Currents": [1, 1]}]})",
       "two different voltages"},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, 1], "Currents": [1, 0], "Temperature": 25}]})",
       "kelvin from 173 to 474 in \"IV Curves\"[0].Temperature"},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, 1], "Currents": [1, 0], "Irradiance": -1}]})",
       "W/m2 from 0 up"},
      {R"({"cells_in_series": 0, "IV Curves": [{"Index": 1, "Voltages": [0, 1], "Currents": [1, 0]}]})",
       "\"cells_in_series\""},
      {R"({"IV Curves": [{"Index": 1, "Voltages": [0, 1], "Currents": [1, 0]},
                         {"Index": 1, "Voltages": [0, 1], "Currents": [1, 0]}]})",
       "a number not used before (it is 1) in \"IV Curves\"[1].Index"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    const std::string path = folder.Write("a.json", c.text);
    const auto curves = ReadCurveSet(path);
    ASSERT_FALSE(curves);
    EXPECT_EQ(curves.error().file, path);
    EXPECT_THAT(curves.error().message, HasSubstr(c.phrase));
  }
}

TEST(ReadIvCurvesJsonTest, SidecarGivenByMistakePointsToItsTable) {
  const TempFolder folder;
  folder.Write("a.csv", "V,I\n0,1\n1,0\n");
  EXPECT_THAT(MessageOf(ReadCurve(folder.Write("a.json", R"({"cells_in_series": 36})"))),
              HasSubstr("for the curve beside it, name a.csv"));
}

TEST(ReadIvCurvesJsonTest, BrokenJsonSaysLineAndColumn) {
  const TempFolder folder;
  const auto curves = ReadCurveSet(folder.Write("a.json", "{\n\"IV Curves\": [}\n"));
  ASSERT_FALSE(curves);
  EXPECT_EQ(curves.error().line, 2);
  EXPECT_EQ(curves.error().column, 15);
}

}  // namespace
}  // namespace lyrefit
