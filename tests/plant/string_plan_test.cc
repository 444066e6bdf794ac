#include "plant/string_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

constexpr char kSheet[] =
    R"({"name": "Elm 60", "cells_in_series": 60, "bypass_diodes": 2, "short_circuit_current_A": 9.59,
 "open_circuit_voltage_V": 39.3, "max_power_current_A": 9.08, "max_power_voltage_V": 32.3,
 "alpha_sc_percent_K": 0.049, "beta_oc_percent_K": -0.277})";

TEST(StringPlan, ReadsATableWithModulesBesideIt) {
  const TempFolder folder;
  folder.Write("modules/elm.json", kSheet);
  const auto plan = ReadPlantPlan(
      folder.Write("plan.csv",
                   "# of 2024\n"
                   "id;modules_in_series;strings_in_parallel;bypass_diodes;module;remark\n"
                   "elm/inv1;20;2;;modules/elm.json;as built\n"
                   "elm/inv1/comb1/str1;19;;3;modules/elm.json;\n"
                   "elm/inv2/*;18;;;;\n"));
  ASSERT_TRUE(plan) << plan.error().ToString();
  ASSERT_EQ((*plan)->lines().size(), 3u);
  const PlannedString& above = (*plan)->lines()[0];
  EXPECT_EQ(above.modules_in_series, 20);
  EXPECT_EQ(above.strings_in_parallel, 2);
  EXPECT_EQ(above.bypass_diodes, 2) << "those of the data sheet";
  ASSERT_TRUE(above.module);
  EXPECT_EQ(above.module->name, "Elm 60");
  EXPECT_EQ(above.module, (*plan)->lines()[1].module) << "read once";
  EXPECT_EQ((*plan)->lines()[1].bypass_diodes, 3);
  EXPECT_EQ((*plan)->lines()[2].strings_in_parallel, 1);
  EXPECT_FALSE((*plan)->lines()[2].module);
}

TEST(StringPlan, ReadsJson) {
  const TempFolder folder;
  folder.Write("elm.json", kSheet);
  const std::string list =
      R"([{"id": "a/1", "modules_in_series": 12, "module": "elm.json"},
          {"id": "a/2", "modules_in_series": 10, "strings_in_parallel": 3}])";
  const auto bare = ReadPlantPlan(folder.Write("plan.json", list));
  const auto nested = ReadPlantPlan(folder.Write("nested.json", "{\"strings\": " + list + "}"));
  for (const auto* plan : {&bare, &nested}) {
    ASSERT_TRUE(*plan) << plan->error().ToString();
    EXPECT_EQ((**plan)->lines().size(), 2u);
    EXPECT_EQ((**plan)->Find("a/2")->strings_in_parallel, 3);
    EXPECT_EQ((**plan)->Find("a/1")->module->cells_in_series, 60);
  }
  EXPECT_EQ((*bare)->Digest(), (*nested)->Digest());
}

TEST(StringPlan, TheMostExactLineCounts) {
  const auto line = [](const char* id, int modules) {
    PlannedString one;
    one.id = id;
    one.modules_in_series = modules;
    return one;
  };
  const PlantPlan plan({line("*", 1), line("s/inv1", 2), line("s/inv1/comb1", 3),
                        line("s/inv?/comb2/*", 4), line("s/inv1/comb1/str7", 5)});
  EXPECT_EQ(plan.Find("t/1")->modules_in_series, 1);
  EXPECT_EQ(plan.Find("s/inv1/comb9/str1")->modules_in_series, 2);
  EXPECT_EQ(plan.Find("s/inv1/comb1/str1")->modules_in_series, 3);
  EXPECT_EQ(plan.Find("s/inv1/comb2/str1")->modules_in_series, 4);
  EXPECT_EQ(plan.Find("s/inv1/comb1/str7")->modules_in_series, 5);
  EXPECT_EQ(plan.Find("s/inv11/comb1/str7")->modules_in_series, 1) << "a level ends at its slash";
  EXPECT_EQ(PlantPlan({line("a/*/c", 1)}).Find("a/b/d"), nullptr);
  EXPECT_NE(PlantPlan({line("a", 1)}).Digest(), PlantPlan({line("a", 2)}).Digest());
}

TEST(StringPlan, SaysWhereATableIsWrong) {
  const TempFolder folder;
  folder.Write("elm.json", kSheet);
  const struct {
    const char* text;
    int line, column;
    const char* phrase;
  } cases[] = {
      {"id,modules_in_serie\na,3\n", 1, 4, "found 'modules_in_serie'"},
      {"id,module\na,elm.json\n", 1, 1, "expected a column modules_in_series"},
      {"id,modules_in_series,id\n", 1, 22, "expected each column once"},
      {"id,modules_in_series\na,3\nb,3.5\n", 3, 3, "found '3.5'"},
      {"id,modules_in_series\na,0\n", 2, 3, "whole number from 1"},
      {"id,modules_in_series\na,3,4\n", 2, 1, "expected 2 fields as in the header, found 3"},
      {"id,modules_in_series\n,3\n", 2, 1, "expected an id"},
      {"id,modules_in_series\na,3\n\na,4\n", 4, 1, "found 'a' as in line 2"},
      {"id,modules_in_series,module\na,3,oak.json\n", 2, 5, "the module 'oak.json'"},
      {"id,modules_in_series\n", 0, 0, "expected a line of a plan"},
  };
  for (const auto& one : cases) {
    const std::string file = folder.Write("plan.csv", one.text);
    ExpectErrorAt(ReadPlantPlan(file), file, one.line, one.column, one.phrase);
  }
}

TEST(StringPlan, SaysWhereJsonIsWrong) {
  const TempFolder folder;
  const struct {
    const char* text;
    int line, column;
    const char* phrase;
  } cases[] = {
      {"[{\"id\": \"a\", \"modules_in_series\": 3},\n {\"id\": \"b\",\n  \"modules_in_series\": "
       "2.5}]",
       3, 3, "a whole number"},
      {"[{\"id\": \"a\",\n\"modules\": 3}]", 2, 1, "no value but those of a plan"},
      {"[{\"id\": \"a\"}]", 1, 1, "modules_in_series"},
      {"{\"plan\": []}", 1, 1, "under \"strings\""},
  };
  for (const auto& one : cases) {
    const std::string file = folder.Write("plan.json", one.text);
    ExpectErrorAt(ReadPlantPlan(file), file, one.line, one.column, one.phrase);
  }
}

TEST(StringPlan, RefusesAModuleThatNoDiodeDescribes) {
  const TempFolder folder;
  folder.Write(
      "flat.json",
      R"({"cells_in_series": 60, "short_circuit_current_A": 9, "open_circuit_voltage_V": 39,
                   "max_power_current_A": 9.5, "max_power_voltage_V": 32})");
  folder.Write("short.json", R"({"cells_in_series": 60, "short_circuit_current_A": 9})");
  const std::string head = "id,modules_in_series,module\na,3,";
  const auto flat = ReadPlantPlan(folder.Write("a.csv", head + "flat.json\n"));
  const auto part = ReadPlantPlan(folder.Write("b.csv", head + "short.json\n"));
  EXPECT_THAT(MessageOf(flat), ::testing::HasSubstr("the module 'flat.json'"));
  EXPECT_THAT(MessageOf(part), ::testing::HasSubstr("open_circuit_voltage_V"));
}

TEST(LayoutOf, TakesThePlanBeforeTheSheet) {
  PlannedString line;
  line.modules_in_series = 19;
  DeviceLayout layout = LayoutOf(line, {60, 2, 20, "module.json"});
  EXPECT_EQ(layout.modules_in_series, 19);
  EXPECT_EQ(layout.module_cells, 60);
  EXPECT_EQ(layout.module_diodes, 2);
  EXPECT_EQ(layout.source, "plan and module.json");
  auto module = std::make_shared<PlannedModule>();
  module->cells_in_series = 72;
  line.module = module;
  layout = LayoutOf(line, {60, 2, 20, ""});
  EXPECT_EQ(layout.module_cells, 72);
  EXPECT_EQ(layout.module_diodes, 3);
  EXPECT_EQ(layout.source, "plan");
}

}  // namespace
}  // namespace lyrefit
