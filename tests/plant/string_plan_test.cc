#include "plant/string_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "cases.h"
#include "read/told.h"

namespace lyrefit {
namespace {

std::string ToldPlan(const std::string& given) {
  return OfFiles(given, [](const std::string& path, const ReadOptions&) {
    const auto plan = ReadPlantPlan(path);
    if (!plan) return "error " + plan.error().ToString();
    std::string told;
    for (const PlannedString& line : (*plan)->lines()) {
      told += fmt::format("{}{}: {} in series, {} in parallel, {} diodes", told.empty() ? "" : "; ",
                          line.id, line.modules_in_series, line.strings_in_parallel,
                          line.bypass_diodes);
      if (line.module == nullptr) continue;
      told += fmt::format(" of {} with {} cells{}", line.module->name, line.module->cells_in_series,
                          line.module == (*plan)->lines()[0].module ? ", read once" : "");
    }
    return told;
  });
}

TEST(StringPlan, IsReadOrSaysWhereItIsWrong) { CheckCases("plant_plans", {{"plan", ToldPlan}}); }

TEST(StringPlan, DigestIsThatOfItsLinesHoweverTheyAreWritten) {
  const TempFolder folder;
  const std::string list = R"([{"id": "a/1", "modules_in_series": 12}])";
  const auto bare = ReadPlantPlan(folder.Write("plan.json", list));
  const auto nested = ReadPlantPlan(folder.Write("nested.json", "{\"strings\": " + list + "}"));
  ASSERT_TRUE(bare && nested);
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
