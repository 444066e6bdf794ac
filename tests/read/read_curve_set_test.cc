#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "error_of.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve_set.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr char kOne[] = "voltage_V,current_A\n0,1\n0.5,0.9\n0.6,0\n";
constexpr char kThree[] =
    "curve,voltage_V,current_A\n7,0,1\n7,0.5,0.9\n7,0.6,0\n3,0,2\n3,0.5,1.8\n3,0.6,0\n"
    "12,0,0.5\n12,0.5,0.4\n12,0.6,0\n";

std::vector<std::string> Ids(const CurveSet& set) {
  std::vector<std::string> ids;
  for (const IvCurve& curve : set.curves) ids.push_back(curve.name);
  return ids;
}

TEST(ReadCurveSetTest, TheIndexGivesEachCurveItsDate) {
  const TempFolder folder;
  folder.Write("roof/curves.csv", kThree);
  for (const std::string name : {"timestamp", "date", "datetime", "time"}) {
    folder.Write("roof/index.csv", "curve," + name +
                                       ",irradiance_W_m2\n3,2025-03-12 10:30,1000\n7,,600\n"
                                       "12,2025-03-12T11:00:05,280\n");
    const auto set = ReadCurveSet(folder.Path("roof"));
    ASSERT_TRUE(set) << set.error().ToString();
    ASSERT_THAT(Ids(*set), ElementsAre("7", "3", "12"));
    EXPECT_EQ(set->curves[0].notes.date, "") << name;
    EXPECT_EQ(set->curves[1].notes.date, "2025-03-12 10:30") << name;
    EXPECT_EQ(set->curves[2].notes.date, "2025-03-12T11:00:05") << name;
  }
}

TEST(ReadCurveSetTest, FolderOfOneTableWithIndexAndDataset) {
  const TempFolder folder;
  const std::string table = folder.Write("roof/curves.csv", kThree);
  folder.Write("roof/index.csv",
               "curve,timestamp,air_temp_C,module_temperature_C,ref_cell1_W_m2,irradiance_W_m2,"
               "temperature_C,isc_A\n"
               "3,noon,11,50,1100,1000,55,2\n7,,11,30,600,,,1\n12,,11,20,280,-5,25,0.5\n");
  folder.Write("roof/dataset.json",
               R"({"name": "a long title", "cells_in_series": 36, "strings_in_parallel": null,
                   "cell_temperature_C": "per curve", "irradiance_W_m2": 1000,
                   "alpha_Isc_A_per_K": 0.0054})");
  for (const std::string& path : {folder.Path("roof"), folder.Path("roof/"), table}) {
    const auto set = ReadCurveSet(path);
    ASSERT_TRUE(set) << set.error().ToString();
    EXPECT_EQ(set->name, "roof");
    EXPECT_EQ(set->source, path);
    EXPECT_THAT(Ids(*set), ElementsAre("7", "3", "12"));
    EXPECT_THAT(set->rejected, IsEmpty());
    EXPECT_THAT(SentencesOf(set->assumptions), IsEmpty());
    const IvCurve& unknown = set->curves[0];
    EXPECT_EQ(unknown.source, table);
    EXPECT_FALSE(unknown.irradiance_known);
    EXPECT_FALSE(unknown.temperature_known);
    EXPECT_THAT(SentencesOf(unknown.assumptions),
                ElementsAre("cell temperature not given: assumed 25 C",
                            "irradiance not given: assumed 1000 W/m2"));
    const IvCurve& noon = set->curves[1];
    EXPECT_TRUE(noon.irradiance_known);
    EXPECT_TRUE(noon.temperature_known);
    EXPECT_EQ(noon.conditions.irradiance_W_m2, 1000);
    EXPECT_EQ(noon.conditions.cell_temperature_K, 55 + 273.15);
    EXPECT_EQ(noon.conditions.cells_in_series, 36);
    EXPECT_EQ(noon.notes.isc_tempco_A_per_K, 0.0054);
    EXPECT_THAT(noon.current_A, ElementsAre(2, 1.8, 0));
    EXPECT_THAT(SentencesOf(noon.assumptions), IsEmpty());
    EXPECT_EQ(set->curves[2].conditions.irradiance_W_m2, 0);
    EXPECT_TRUE(set->curves[2].irradiance_known);
  }
}

TEST(ReadCurveSetTest, ModuleTemperatureAndKelvinInTheIndexAreTakenAndSaid) {
  const TempFolder folder;
  folder.Write("s/curves.csv", kThree);
  folder.Write("s/index.csv",
               "curve;G;air_temp_C;module_temperature_K\n3;500;10;300,15\n"
               "7;600;10;310,15\n12;700;10;320,15\n");
  const auto set = ReadCurveSet(folder.Path("s"));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_DOUBLE_EQ(set->curves[0].conditions.cell_temperature_K, 310.15);
  EXPECT_EQ(set->curves[0].conditions.irradiance_W_m2, 600);
  EXPECT_THAT(SentencesOf(set->assumptions), Contains(HasSubstr("converted from kelvin")));
  EXPECT_THAT(SentencesOf(set->assumptions),
              Contains(HasSubstr("taken as the temperature of the cells")));
}

TEST(ReadCurveSetTest, CommonSentencesAreSaidOnce) {
  const TempFolder folder;
  const auto set = ReadCurveSet(folder.Write("a.csv", kThree));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_EQ(set->name, "a");
  EXPECT_THAT(SentencesOf(set->assumptions),
              ElementsAre(HasSubstr("cells in series"), HasSubstr("assumed 25 C"),
                          HasSubstr("assumed 1000 W/m2")));
  for (const IvCurve& curve : set->curves) {
    EXPECT_THAT(SentencesOf(curve.assumptions), IsEmpty());
    EXPECT_FALSE(curve.irradiance_known);
    EXPECT_FALSE(curve.temperature_known);
  }
}

TEST(ReadCurveSetTest, ConditionsPerRowGoBeforeTheNominalOnes) {
  const TempFolder folder;
  folder.Write("case.json", R"({"cells_in_series": 2, "nominal_irradiance_Wm2": 1000,
                                "nominal_temperature_C": 25, "isc_tempco_per_K": 0.0005})");
  const auto set = ReadCurveSet(
      folder.Write("case.csv",
                   "voltage_V,current_A,sweep,irradiance_Wm2\n0,1,0,198\n1,0.9,0,200\n1.2,0,0,202\n"
                   "0,5,1,1000\n1,4.9,1,1000\n1.2,0,1,1000\n0,0,2,0\n1,-0.1,2,0\n1.2,-2,2,0\n"));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_THAT(Ids(*set), ElementsAre("0", "1", "2"));
  EXPECT_DOUBLE_EQ(set->curves[0].conditions.irradiance_W_m2, 200);
  EXPECT_EQ(set->curves[1].conditions.irradiance_W_m2, 1000);
  EXPECT_EQ(set->curves[2].conditions.irradiance_W_m2, 0);
  for (const IvCurve& curve : set->curves) {
    EXPECT_EQ(curve.size(), 3U);
    EXPECT_EQ(curve.conditions.cell_temperature_K, 298.15);
    EXPECT_EQ(curve.conditions.cells_in_series, 2);
    EXPECT_EQ(curve.notes.isc_tempco_per_K, 0.0005);
    EXPECT_TRUE(curve.irradiance_known);
    EXPECT_TRUE(curve.temperature_known);
    EXPECT_THAT(SentencesOf(curve.assumptions), Not(Contains(HasSubstr("differs"))));
  }
}

TEST(ReadCurveSetTest, UpAndDownStayApartAndVariedIsNotStated) {
  const TempFolder folder;
  folder.Write("b.json", R"({"nominal_irradiance_Wm2": "varied", "nominal_temperature_C": 40})");
  folder.Write("b-index.csv", "sweep,poa\n0,800\n1,\n");
  const auto set = ReadCurveSet(
      folder.Write("b.csv", "V,I,sweep\n0,1,0\n0.5,0.9,0\n0.6,0,0\n0.6,0,1\n0.5,0.9,1\n0,1,1\n"));
  ASSERT_TRUE(set) << set.error().ToString();
  ASSERT_EQ(set->curves.size(), 2U);
  EXPECT_EQ(set->curves[0].conditions.irradiance_W_m2, 800);
  EXPECT_FALSE(set->curves[1].irradiance_known);
  EXPECT_TRUE(set->curves[1].temperature_known);
  EXPECT_EQ(set->curves[1].conditions.cell_temperature_K, 313.15);
}

TEST(ReadCurveSetTest, FolderOfTablesTakesSidecarsIndexAndDataset) {
  const TempFolder folder;
  folder.Write("f/a.csv", kOne);
  folder.Write("f/a.json", R"({"nominal_irradiance_Wm2": 300, "name": "other"})");
  folder.Write("f/b.tsv", "V\tI\n0\t1\n0.5\t0.9\n0.6\t0\n");
  folder.Write("f/c.txt", "V I\n0 1\n0.5 0.9\n0.6 oops\n");
  folder.Write("f/d.csv", kOne);
  folder.Write("f/d.json", "{");
  folder.Write("f/dataset.json", R"({"cells_in_series": 60, "nominal_temperature_C": 33})");
  folder.Write("f/index.csv", "curve,file,G\n1,b.tsv,500\n2,a,400\n");
  const auto set = ReadCurveSet(folder.Path("f"));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_THAT(Ids(*set), ElementsAre("a", "b"));
  EXPECT_EQ(set->curves[0].conditions.irradiance_W_m2, 300);
  EXPECT_THAT(SentencesOf(set->curves[0].assumptions),
              Contains(HasSubstr("in the index (400 W/m2) differs")));
  EXPECT_EQ(set->curves[1].conditions.irradiance_W_m2, 500);
  EXPECT_EQ(set->curves[1].source, folder.Path("f/b.tsv"));
  for (const IvCurve& curve : set->curves) {
    EXPECT_EQ(curve.conditions.cells_in_series, 60);
    EXPECT_EQ(curve.conditions.cell_temperature_K, 33 + 273.15);
  }
  ASSERT_EQ(set->rejected.size(), 2U);
  EXPECT_EQ(set->rejected[1].id, "d");
  EXPECT_EQ(set->rejected[1].error.file, folder.Path("f/d.json"));
  EXPECT_EQ(set->rejected[0].id, "c");
  EXPECT_EQ(set->rejected[0].error.file, folder.Path("f/c.txt"));
  EXPECT_EQ(set->rejected[0].error.line, 4);
  EXPECT_EQ(set->rejected[0].error.column, 5);
}

TEST(ReadCurveSetTest, IvCurvesFileKeepsTheCurvesThatCanBeRead) {
  const TempFolder folder;
  const std::string path = folder.Write("set.json", R"({"cells_in_series": 72, "IV Curves": [
    {"Index": 1, "Voltages": ["0", "20", "40"], "Currents": ["1", "0.9", "0"],
     "Temperature": "298.15", "Irradiance": null},
    {"Index": 4, "Voltages": [0, 20, 40], "Currents": [1, "NaN", 0]},
    {"Index": 5, "Voltages": [0, 20, 40], "Currents": [2, 1.9, 0],
     "Temperature": 318.15, "Irradiance": 800}]})");
  const auto set = ReadCurveSet(path);
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_THAT(Ids(*set), ElementsAre("1", "5"));
  EXPECT_FALSE(set->curves[0].irradiance_known);
  EXPECT_TRUE(set->curves[0].temperature_known);
  EXPECT_TRUE(set->curves[1].irradiance_known);
  EXPECT_EQ(set->curves[1].conditions.irradiance_W_m2, 800);
  ASSERT_EQ(set->rejected.size(), 1U);
  EXPECT_EQ(set->rejected[0].id, "4");
  EXPECT_THAT(set->rejected[0].error.message, HasSubstr("\"IV Curves\"[1].Currents[1]"));
}

TEST(ReadCurveSetTest, ABadReadingOfOnePixelRejectsThatPixel) {
  const TempFolder folder;
  const auto set = ReadCurveSet(folder.Write(
      "p.csv", "sweep,V,I1,I2\n1,0,2,3\n1,0.4,1,2\n1,0.5,0,0\n2,0.5,0,0\n2,0.4,x,2\n2,0,2,3\n"));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_THAT(Ids(*set), ElementsAre("I2"));
  EXPECT_EQ(set->curves[0].size(), 6U);
  ASSERT_EQ(set->rejected.size(), 1U);
  EXPECT_EQ(set->rejected[0].id, "I1");
  EXPECT_EQ(set->rejected[0].error.line, 6);
}

TEST(ReadCurveSetTest, TwoEntriesOfOneIndexAreAnError) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf(ReadCurveSet(folder.Write("set.json", R"({"IV Curves": [
    {"Index": 1, "Voltages": [0, 20], "Currents": [1, 0]},
    {"Index": 1, "Voltages": [0, 20], "Currents": [1, "x"]}]})"))),
              HasSubstr("a number not used before (it is 1)"));
}

TEST(ReadCurveSetTest, BrokenCurvesOfATableAreRejectedWithTheirPlace) {
  const TempFolder folder;
  const std::string path = folder.Write("a.csv",
                                        "curve,voltage_V,current_A,irradiance\n1,0,1,500\n"
                                        "1,0.5,0.9,500\n2,0,1,500\n3,0,nan,500\n3,0.5,0.9,500\n"
                                        "4,0,1,500\n4,0.5,abc,500\n5,0,1,-50\n5,0.5,0.9,-50\n"
                                        "6,0,1,-5\n6,0.5,0.9,-7\n");
  const auto set = ReadCurveSet(path);
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_THAT(Ids(*set), ElementsAre("1", "6"));
  EXPECT_EQ(set->curves[1].conditions.irradiance_W_m2, 0);
  const struct {
    const char* id;
    int line, column;
    const char* phrase;
  } kExpected[] = {{"2", 4, 0, "expected at least two points, found 1"},
                   {"5", 9, 0, "an irradiance from 0 W/m2 up, found a mean of -50"},
                   {"3", 5, 5, "expected a finite number in column current_A, found 'nan'"},
                   {"4", 8, 7, "expected a number in column current_A, found 'abc'"}};
  ASSERT_EQ(set->rejected.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    SCOPED_TRACE(kExpected[i].id);
    EXPECT_EQ(set->rejected[i].id, kExpected[i].id);
    EXPECT_EQ(set->rejected[i].error.file, path);
    EXPECT_EQ(set->rejected[i].error.line, kExpected[i].line);
    EXPECT_EQ(set->rejected[i].error.column, kExpected[i].column);
    EXPECT_THAT(set->rejected[i].error.message, HasSubstr(kExpected[i].phrase));
  }
}

TEST(ReadCurveSetTest, WhereAllCurvesAreBrokenTheFirstErrorIsTheAnswer) {
  const TempFolder folder;
  folder.Write("f/a.csv", "V,I\n0,x\n");
  folder.Write("f/b.csv", "V,I\n0,1\n0.1,y\n");
  for (const std::string& path :
       {folder.Write("t.csv", "curve,V,I\n1,0,x\n2,0,y\n"), folder.Path("f")}) {
    const auto set = ReadCurveSet(path);
    ASSERT_FALSE(set);
    EXPECT_THAT(set.error().message, HasSubstr("expected a number in column I, found 'x'"));
    EXPECT_EQ(set.error().line, 2);
  }
}

TEST(ReadCurveSetTest, ACurveWithoutARowOfTheIndexIsReadAndSaysSo) {
  const TempFolder folder;
  folder.Write("a-index.csv", "curve,irradiance\n3,500\n12,600\n");
  folder.Write("a.json", R"({"nominal_irradiance_Wm2": 1000, "nominal_temperature_C": 30})");
  const auto set = ReadCurveSet(folder.Write("a.csv", kThree));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_FALSE(set->curves[0].irradiance_known);
  EXPECT_TRUE(set->curves[0].temperature_known);
  EXPECT_THAT(SentencesOf(set->curves[0].assumptions),
              Contains("the index has no row for this curve"));
  EXPECT_TRUE(set->curves[1].irradiance_known);
  EXPECT_THAT(SentencesOf(set->curves[1].assumptions), IsEmpty());
}

TEST(ReadCurveSetTest, ErrorsInTheIndexNameTheirPlace) {
  const TempFolder folder;
  const std::string path = folder.Write("a.csv", kThree);
  const struct {
    const char* text;
    int line, column;
    const char* phrase;
  } kCases[] = {
      {"curve,G\n3,1\n7,1\n3,1\n", 4, 1,
       "expected one row a curve, found a second one of curve '3'"},
      {"curve,G\n3,1\n03,1\n", 3, 1, "a second one of curve '3'"},
      {"curve,G\n3,1\n8,1\n", 3, 1, "found one of curve '8'"},
      {"curve,G\n3,sunny\n", 2, 3, "expected a number in column G, found 'sunny'"},
      {"curve,G\n3,nan\n", 2, 3, "expected a finite number in column G"},
      {"curve,G\n3,-20.5\n", 2, 3, "expected an irradiance from 0 W/m2 up in column G"},
      {"curve,G,temperature_C\n3,1,298.15\n", 2, 5,
       "looks like kelvin (name the column temperature_K)"},
      {"curve,G,temperature_F\n3,1,77\n", 1, 9, "expected C or K"},
      {"curve,G\n,1\n", 2, 1, "expected the id of a curve in column curve, found an empty field"},
      {"curve,G\nA1,1\n", 2, 1, "expected a number in column curve, found 'A1'"},
      {"curve,G\n3.5,1\n", 2, 1, "expected a whole number in column curve"},
      {"curve,G\n3\n", 2, 1, "expected 2 fields"},
      {"name,G\n3,1\n", 1, 1, "expected a header with a column curve, found 'name,G'"},
      {"# nothing\n", 0, 0, "only blank lines and comments"},
  };
  const std::string index = folder.Path("a-index.csv");
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    folder.Write("a-index.csv", c.text);
    ExpectErrorAt(ReadCurveSet(path), index, c.line, c.column, c.phrase);
  }
}

TEST(ReadCurveSetTest, WhatIsNoSetIsRefused) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.Path("empty"));
  folder.Write("without/picture.png", "x");
  folder.Write("without/index.csv", "curve,G\n1,1\n");
  folder.Write("one/curve.csv", kOne);
  folder.Write("twice/a.csv", kOne);
  folder.Write("twice/a.txt", kOne);
  folder.Write("missing/a.csv", kOne);
  folder.Write("missing/index.csv", "file,G\nb.csv,1\n");
  folder.Write("plain.csv", kOne);
  folder.Write("text.csv", "curve,V,I\nA1,0,1\nA1,1,0\n");
  folder.Write("remark/curves.csv", kThree);
  folder.Write("remark/dataset.json", R"({"cell_temperature_C": "25 C"})");
  const struct {
    const char* name;
    const char* phrase;
  } kCases[] = {{"nowhere.csv", "nowhere.csv"},
                {"nowhere.json", "nowhere.json"},
                {"empty", "found an empty folder"},
                {"without", "found a folder without"},
                {"one", "found a folder of one (it holds curve.csv)"},
                {"twice", "found a second one of curve 'a'"},
                {"missing", "found one of curve 'b'"},
                {"plain.csv", "expected a column curve or sweep"},
                {"text.csv", "text.csv:2:1: expected a number in column curve, found 'A1'"},
                {"remark", "expected a number in \"cell_temperature_C\""}};
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.name);
    const auto set = ReadCurveSet(folder.Path(c.name));
    ASSERT_FALSE(set);
    EXPECT_THAT(set.error().ToString(), HasSubstr(c.phrase));
  }
  ReadOptions options;
  options.curve = 3;
  EXPECT_THAT(MessageOf(ReadCurveSet(folder.Write("three.csv", kThree), options)),
              HasSubstr("a set is read whole"));
}

TEST(HoldsCurveSetTest, LooksAtNamesAndHeaders) {
  const TempFolder folder;
  folder.Write("set/curves.csv", kThree);
  folder.Write("one/curve.csv", kOne);
  folder.Write("tables/a.csv", kOne);
  folder.Write("other/readme.md", "x");
  folder.Write("one.csv", kOne);
  folder.Write("three.csv", kThree);
  folder.Write("single.csv", "curve,V,I\n1,0,1\n1,1,0\n");
  folder.Write("updown.csv", "V,I,sweep,G\n0,1,0,999\n1,0,0,999\n1,0,1,1001\n0,1,1,1001\n");
  folder.Write("levels.csv", "V,I,sweep,G\n0,1,0,500\n1,0,0,500\n1,0,1,1000\n0,1,1,1000\n");
  folder.Write("indexed.csv", "V,I,sweep\n0,1,0\n1,0,0\n1,0,1\n0,1,1\n");
  folder.Write("indexed-index.csv", "sweep,G\n0,500\n1,1000\n");
  folder.Write("broken.csv", "curve,V,I\n1,0,x\n2,0,1\n2,1,0\n");
  folder.Write("two.json", R"({"IV Curves": [{}, {}]})");
  folder.Write("one.json", R"({"IV Curves": [{}]})");
  folder.Write("bad.json", "{");
  for (const char* name :
       {"set", "tables", "three.csv", "levels.csv", "indexed.csv", "broken.csv", "two.json"}) {
    EXPECT_TRUE(HoldsCurveSet(folder.Path(name))) << name;
  }
  for (const char* name : {"one", "other", "one.csv", "single.csv", "updown.csv", "one.json",
                           "bad.json", "nowhere", "nowhere.csv"}) {
    EXPECT_FALSE(HoldsCurveSet(folder.Path(name))) << name;
  }
}

}  // namespace
}  // namespace lyrefit
