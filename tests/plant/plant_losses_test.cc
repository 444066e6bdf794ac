#include "plant/plant_losses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "../error_of.h"
#include "plant/plant_figures.h"
#include "plant/plant_page.h"
#include "plant/plant_runs.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(PlantLosses, AreOnThePageOfDevicesOverTime) {
  const TempFolder folder;
  std::filesystem::copy(std::filesystem::path(LYREFIT_DATA_DIR) / "trend" / "plant",
                        folder.Path("plant"), std::filesystem::copy_options::recursive);
  folder.Write("plant/roof/comb2/mod2.csv", "date,voltage_V,current_A\nno sweep\n");
  BatchReadOptions reading;
  reading.reading.whole_files = true;
  const auto source = OpenBatch({folder.Path("plant")}, reading);
  ASSERT_TRUE(source) << MessageOf(source);
  ASSERT_TRUE(RunBatch(source->get(), TrendTask({}), IntoPlant(folder.Path("out"))));
  const auto written = WritePlantPage(folder.Path("out"), folder.Path("plant.html"), "Plant");
  ASSERT_TRUE(written) << MessageOf(written);
  const std::string page = FileText(folder.Path("plant.html"));
  EXPECT_THAT(page, HasSubstr("1 of 4 strings show no cause. 2 need work: "));
  EXPECT_THAT(page, HasSubstr("Energy lost since the reference days, by part"));
  EXPECT_THAT(page, HasSubstr("power lost now (%)"));
  EXPECT_THAT(page, HasSubstr("mostly by"));
  EXPECT_THAT(page, HasSubstr("2025-01-01 "));
}

TEST(PlantLosses, AreMeansByPowerOfGroupsAndPlant) {
  std::vector<ResultColumn> columns = {{"reference_power_W", "W", CellType::kNumber, ""}};
  for (const PlantLossPart& part : kPlantLossParts) {
    columns.push_back({part.column, "%", CellType::kNumber, ""});
  }
  columns.push_back({"loss_now_total_percent", "%", CellType::kNumber, ""});
  PlantLossCounter counter(columns);
  counter.Add("a/1", {{100.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 2.0}});
  counter.Add("a/2", {{300.0, 5.0, 0.0, 0.0, 0.0, 0.0, 5.0, 4.0}});
  counter.Add("b/1", {{100.0, 0.0, 3.0, 0.0, 0.0, 0.0, 3.0, {}}});
  counter.Add("b/2", {{100.0, {}, 4.0, 0.0, {}, 0.0, 5.0, 0.0}});   // two parts are not told
  counter.Add("b/3", {{100.0, 9.0, 4.0, 0.0, 0.0, 0.0, {}, 0.0}});  // nor is the total
  counter.Add("c/1", {{100.0, 1.0, 0.0, 0.0, {}, 0.0, 1.0, 2.0}});
  const PlantLossSummary& summary = counter.summary();
  EXPECT_EQ(summary.plant.rows, 5);
  const PlantLosses& a = summary.groups.at("a");
  EXPECT_DOUBLE_EQ(a.parts.front() / a.weights.front(), 4);
  EXPECT_DOUBLE_EQ(a.parts.back() / a.weights.back(), 4);
  EXPECT_DOUBLE_EQ(a.lost_W, 14);
  const PlantLosses& b = summary.groups.at("b");
  EXPECT_EQ(b.weights, (std::vector<double>{100, 200, 200, 100, 200, 200}));
  EXPECT_DOUBLE_EQ(b.parts[1], 700);
  EXPECT_DOUBLE_EQ(summary.plant.parts.back() / summary.plant.weights.back(), 2500.0 / 700);
  const auto rows = LossesFigure(summary).readings.rows;
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0],
            (block::Table::Row{"all", "5", "2.83", "1.00", "0.00", "0.00", "0.00", "3.57", "16"}));
  EXPECT_EQ(rows[3],
            (block::Table::Row{"c", "1", "1.00", "0.00", "0.00", "not told", "0.00", "1.00", "2"}));
}

}  // namespace
}  // namespace lyrefit
