#include "lyrefit/read/json_curves.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Expected<std::vector<RawCurve>> Find(const char* text, const ReadOptions& options = {}) {
  TRY(JsonCurves found, FindJsonCurves(nlohmann::json::parse(text), "f.json", options));
  return std::move(found.curves);
}

TEST(FindJsonCurvesTest, ReadsEveryShape) {
  const char* const kShapes[] = {
      R"({"v": [0, 0.5, 0.6], "i": [2, 1, 0]})",
      R"({"voltage_mV": [0, 500, 600], "current_A": ["2", "1", "0"]})",
      R"({"data": {"voltage": [0, 0.5, 0.6], "current": [2, 1, 0]}})",
      R"([{"V": 0, "I": 2, "note": "x"}, {"V": 0.5, "I": 1}, {"V": 0.6, "I": 0}])",
      R"({"v": {"0": 0, "1": 0.5, "2": 0.6}, "i": {"0": 2, "1": 1, "2": 0}})",
      R"({"0": {"v": 0, "i": 2}, "1": {"v": 0.5, "i": 1}, "2": {"v": 0.6, "i": 0}})",
      R"({"columns": ["v", "i"], "index": [0, 1, 2], "data": [[0, 2], [0.5, 1], [0.6, 0]]})",
      R"({"schema": {"fields": []}, "data": [{"v": 0, "i": 2}, {"v": 0.5, "i": 1},
          {"v": 0.6, "i": 0}]})",
  };
  for (const char* text : kShapes) {
    SCOPED_TRACE(text);
    const auto curves = Find(text);
    ASSERT_TRUE(curves) << curves.error().ToString();
    ASSERT_EQ(curves->size(), 1U);
    EXPECT_THAT(curves->front().curve.voltage_V, ElementsAre(0, 0.5, 0.6));
    EXPECT_THAT(curves->front().curve.current_A, ElementsAre(2, 1, 0));
    EXPECT_FALSE(curves->front().per_area);
  }
}

TEST(FindJsonCurvesTest, NumbersBesideAndAroundACurveAreItsConditions) {
  const auto curves = Find(R"({"cells_in_series": 60, "irradiance_W_m2": 800, "runs": [
      {"name": "a", "V": [0, 1], "I": [1, 0], "cell_temperature_C": 40},
      {"name": "b", "V": [0, 1], "I": [2, 0], "irradiance_W_m2": 500}]})");
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->size(), 2U);
  EXPECT_EQ((*curves)[0].curve.name, "a");
  EXPECT_EQ((*curves)[0].stated.cells_in_series, 60);
  EXPECT_EQ((*curves)[0].stated.irradiance_W_m2, 800);
  EXPECT_EQ((*curves)[0].stated.temperature_C, 40);
  EXPECT_EQ((*curves)[1].stated.irradiance_W_m2, 500);
  EXPECT_FALSE((*curves)[1].stated.temperature_C);
}

TEST(FindJsonCurvesTest, NomadArchivesAreInTheirUnits) {
  const auto curves = Find(R"({"data": {"active_area": 0.16, "jv_curve": [
      {"cell_name": "b_for", "light_intensity": 100, "voltage": [0, 1], "current_density": [20, 0]},
      {"cell_name": "b_rev", "light_intensity": 100, "voltage": [1, 0], "current_density": [0, 21]}
      ]}})");
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->size(), 1U);
  const RawCurve& pixel = curves->front();
  EXPECT_EQ(pixel.curve.name, "b");
  EXPECT_TRUE(pixel.per_area);
  EXPECT_THAT(pixel.curve.current_A, ElementsAre(0.02, 0, 0, 0.021));
  EXPECT_THAT(pixel.curve.sweep, ElementsAre(1, 1, 2, 2));
  EXPECT_EQ(pixel.stated.notes.area_cm2, 0.16);
  EXPECT_EQ(pixel.stated.irradiance_W_m2, 1000);
}

TEST(FindJsonCurvesTest, SweepsOfOneCellAndOppositeDirectionsAreOneCurve) {
  const auto curves = Find(R"json({"data": [
      {"direction": "FWD", "sample": "S", "cell": "A", "settings": {"area [cm2]": 0.2},
       "measurements": [{"V_set [V]": 9, "V_corr [V]": 0, "I_corr [mA]": 5},
                        {"V_set [V]": 9, "V_corr [V]": 1, "I_corr [mA]": 1}]},
      {"direction": "REV", "sample": "S", "cell": "A",
       "measurements": [{"V_corr [V]": 0, "I_corr [mA]": 6}, {"V_corr [V]": 1, "I_corr [mA]": 2}]},
      {"direction": "FWD", "sample": "S", "cell": "A",
       "measurements": [{"V_corr [V]": 0, "I_corr [mA]": 7}, {"V_corr [V]": 1, "I_corr [mA]": 3}]}
      ]})json");
  ASSERT_TRUE(curves) << curves.error().ToString();
  ASSERT_EQ(curves->size(), 2U);
  EXPECT_EQ((*curves)[0].curve.name, "S A");
  EXPECT_THAT((*curves)[0].curve.voltage_V, ElementsAre(0, 1, 1, 0));
  EXPECT_THAT((*curves)[0].curve.current_A, ElementsAre(0.005, 0.001, 0.002, 0.006));
  EXPECT_EQ((*curves)[0].stated.notes.area_cm2, 0.2);
  EXPECT_EQ((*curves)[1].curve.name, "S A (2)");  // a repeat
}

TEST(FindJsonCurvesTest, NamedListsAndPairsAreCurves) {
  const auto named = Find(R"json({"measurement_condition": {"temperature": 30, "Suns": 0.5},
      "experimental_data": [{"row_name": "Voltage(V)", "data": [0, 1]},
                            {"row_name": "Current(mA)", "data": [5, 1]}]})json");
  ASSERT_TRUE(named) << named.error().ToString();
  EXPECT_THAT(named->front().curve.current_A, ElementsAre(0.005, 0.001));
  EXPECT_EQ(named->front().stated.irradiance_W_m2, 500);
  EXPECT_EQ(named->front().stated.temperature_C, 30);
  const auto pairs = Find(R"({"PV1": [[0, 5], [1, 5], [2, 4], [3, 3], [4, 0]]})");
  ASSERT_TRUE(pairs) << pairs.error().ToString();
  EXPECT_EQ(pairs->front().curve.name, "PV1");
  EXPECT_THAT(pairs->front().curve.voltage_V, ElementsAre(0, 1, 2, 3, 4));
}

TEST(FindJsonCurvesTest, ACurrentWithoutUnitHasThatOfTheDensityBesideIt) {
  for (const auto& [density, current_A] : {std::pair(25, 0.005), std::pair(25000, 5.0)}) {
    const auto curves = Find(
        fmt::format(R"({{"area_cm2": 0.2, "V": [0, 1], "I": [5, 5], "J": [{0}, {0}]}})", density)
            .c_str());
    ASSERT_TRUE(curves) << curves.error().ToString();
    EXPECT_DOUBLE_EQ(curves->front().curve.current_A[0], current_A);
    EXPECT_TRUE(curves->front().curve.current_unit_known);
  }
}

TEST(FindJsonCurvesTest, ASunsVocTraceIsACurveOfItsBrightestLight) {
  const char* text = R"json({"Voc(V)": [0.5, 0.6, 0.7], "subcell 0 Suns": [0, 0, 0],
                         "subcell 0 IL(A)": [1, 3, 10]})json";
  const auto curves = Find(text);
  ASSERT_TRUE(curves) << curves.error().ToString();
  EXPECT_THAT(curves->front().curve.voltage_V, ElementsAre(0.5, 0.6, 0.7));
  EXPECT_THAT(curves->front().curve.current_A, ElementsAre(9, 7, 0));
  const char* suns = R"({"V": [0.5, 0.6], "Suns": [0.1, 1]})";
  EXPECT_THAT(Find(suns).error().message, HasSubstr("--isc-A"));
  ReadOptions options;
  options.isc_A = 2;
  EXPECT_THAT(Find(suns, options)->front().curve.current_A, ElementsAre(1.8, 0));
}

TEST(FindJsonCurvesTest, SeveralCurrentsAreSeveralCurvesOrOneByColumn) {
  const char* text = R"({"v": [0, 1], "i1": [1, 0], "i2": [2, 0]})";
  EXPECT_EQ(Find(text)->size(), 2U);
  ReadOptions options;
  options.column = "i2";
  const auto one = Find(text, options);
  ASSERT_EQ(one->size(), 1U);
  EXPECT_EQ(one->front().curve.current_A[0], 2);
  options.column = "i3";
  EXPECT_THAT(Find(text, options).error().message, HasSubstr("1 'i1', 2 'i2'"));
}

TEST(FindJsonCurvesTest, AnInvalidCurveLeavesTheOthers) {
  const auto found =
      FindJsonCurves(nlohmann::json::parse(R"([{"name": "a", "v": [0, 1], "i": [1, "x"]},
                                {"name": "b", "v": [0, 1], "i": [1, 0]}])"),
                     "f.json", {});
  ASSERT_TRUE(found);
  ASSERT_EQ(found->curves.size(), 1U);
  EXPECT_EQ(found->curves[0].curve.name, "b");
  ASSERT_EQ(found->rejected.size(), 1U);
  EXPECT_EQ(found->rejected[0].id, "a");
  EXPECT_THAT(found->rejected[0].error.message, HasSubstr("in \"i\"[1], found 'x'"));
}

TEST(FindJsonCurvesTest, RefusesWhatIsBrokenOrNoCurve) {
  const struct {
    const char* text;
    const char* phrase;
  } kCases[] = {
      {R"({})", "IV Curves"},
      {R"([1, 2])", "voltage_V"},
      {R"({"v": [0, 1], "p": [1, 0]})", "voltage_V"},
      {R"({"v": [0, 1], "i": [1, 0, 0]})", "found 3 and 2"},
      {R"({"v": [0, 1], "i": [1, null]})", "expected a finite number in \"i\"[1], found 'null'"},
      {R"([{"v": 0, "i": 1}, {"v": 1}])", "expected a finite number in \"i\"[1]"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    const auto curves = Find(c.text);
    ASSERT_FALSE(curves);
    EXPECT_EQ(curves.error().file, "f.json");
    EXPECT_THAT(curves.error().message, HasSubstr(c.phrase));
  }
}

}  // namespace
}  // namespace lyrefit
