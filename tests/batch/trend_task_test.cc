#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../error_of.h"
#include "lyrefit/batch/plant_page.h"
#include "lyrefit/batch/plant_summary.h"
#include "lyrefit/read/date_time.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kDays = 120;
constexpr double kThermal_V = 60 * 1.1 * 0.0256926;  // n Ns kT/q at 25 C

// Sweeps of a module of 60 cells at 25 C: three lights a day, with a ripple of a few parts in ten
// thousand. The light on it falls by `dirt` a day, and its series resistance grows from day 60 on.
std::string Module(double dirt, double ohm_a_day) {
  std::ostringstream text;
  text << "date,irradiance_Wm2,temperature_C,cells_in_series,voltage_V,current_A\n";
  for (int day = 0; day < kDays; ++day) {
    for (int k = 0; k < 3; ++k) {
      const double light = 700 + 100 * k;
      const double ripple = 1 + 4e-4 * std::sin(17.0 * day + 5 * k);
      const double photo_A = 9e-3 * light * (1 - dirt * day) * ripple;
      const double series_ohm =
          0.3 + (day > 60 ? ohm_a_day * (day - 60) : 0) + 0.002 * std::cos(23.0 * day + k);
      const double saturation_A = 9 / std::expm1(38 / kThermal_V);
      std::string voltages, currents;
      for (int i = 0; i < 40; ++i) {
        const double current_A = photo_A * (1 - std::pow(i / 39.0, 3));
        const double voltage_V =
            kThermal_V * std::log1p((photo_A - current_A) / saturation_A) - current_A * series_ohm;
        if (voltage_V < 0) continue;
        voltages += fmt::format("{}{:.4f}", voltages.empty() ? "" : " ", voltage_V);
        currents += fmt::format("{}{:.5f}", currents.empty() ? "" : " ", current_A);
      }
      text << fmt::format("{} {:02}:00:00,{},25,60,{},{}\n", DateText(1735689600 + kDay_s * day),
                          9 + k, light, voltages, currents);
    }
  }
  return text.str();
}

class TrendTaskTest : public testing::Test {
 protected:
  TrendTaskTest() {
    folder_.Write("plant/inv1/comb1/str1.csv", Module(0, 0));
    folder_.Write("plant/inv1/comb1/str2.csv", Module(0, 0.006));
    folder_.Write("plant/inv1/comb2/str1.csv", Module(5e-4, 0));
    folder_.Write("plant/inv1/comb2/str2.csv", "date,voltage_V,current_A\nno sweep\n");
  }

  Expected<BatchSummary> Run(const BatchOptions& options, const Observer& observer = {}) const {
    BatchReadOptions reading;
    reading.shard = options.shard;
    reading.reading.whole_files = true;
    auto source = OpenBatch({folder_.Path("plant")}, reading);
    if (!source) return tl::unexpected(source.error());
    return RunBatch(source->get(), TrendTask({}), options, observer);
  }

  std::vector<nlohmann::json> Rows(const std::string& out) const {
    std::vector<nlohmann::json> rows;
    std::istringstream lines(FileText(folder_.Path(out) + "/results.jsonl"));
    for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
    return rows;
  }

  TempFolder folder_;
};

TEST_F(TrendTaskTest, EachFileIsADeviceWithARowOfItsTrend) {
  const auto summary = Run(Into(folder_.Path("out")));
  ASSERT_TRUE(summary) << MessageOf(summary);
  const std::vector<nlohmann::json> rows = Rows("out");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["id"], "inv1/comb1/str1");
  for (int r = 0; r < 3; ++r) {
    EXPECT_EQ(rows[r]["status"], "fine") << rows[r]["reason"];
    EXPECT_EQ(rows[r]["measurements"], 3 * kDays);
    EXPECT_EQ(rows[r]["days"], kDays);
    EXPECT_EQ(rows[r]["first"], "2025-01-01 09:00:00");
    double parts = 0;
    for (const char* part : {"light", "resistance_series", "recombination", "shunt", "mismatch"}) {
      parts += rows[r]["loss_" + std::string(part) + "_percent"].get<double>();
    }
    EXPECT_NEAR(parts, rows[r]["loss_total_percent"].get<double>(), 1e-6);
  }
  EXPECT_TRUE(rows[0]["cause"].is_null()) << rows[0]["verdict"];
  EXPECT_EQ(rows[0]["onsets"], 0);
  EXPECT_NEAR(rows[0]["loss_total_percent"].get<double>(), 0, 0.3);
  // 0.006 ohm a day over the last 60 days.
  EXPECT_EQ(rows[1]["cause"], "growing_series_resistance");
  EXPECT_EQ(rows[1]["cause_about"], "device");
  EXPECT_THAT(rows[1]["onset_date"].get<std::string>(), HasSubstr("2025-03-0"));
  const double lost_W = rows[1]["recoverable_power_W"];
  const double expected_W = 0.006 * 45 * 8.4 * 8.4;  // at the middle of the last 30 days
  EXPECT_NEAR(lost_W, expected_W, 0.15 * expected_W);
  // 5e-4 a day: light alone.
  EXPECT_NEAR(rows[2]["light_rate_percent"].get<double>(), -18.25, 1);
  EXPECT_GT(rows[2]["loss_light_percent"], 0.9 * rows[2]["loss_total_percent"].get<double>());
}

TEST_F(TrendTaskTest, BrokenFileIsABrokenRow) {
  ASSERT_TRUE(Run(Into(folder_.Path("out"))));
  const nlohmann::json row = Rows("out").at(3);
  EXPECT_EQ(row["id"], "inv1/comb2/str2");
  EXPECT_EQ(row["status"], "broken");
  EXPECT_NE(row["reason"], "");
  EXPECT_TRUE(row["loss_total_percent"].is_null());
}

TEST_F(TrendTaskTest, ThreadsShardsAndResumeGiveTheSameBytes) {
  BatchOptions options = Into(folder_.Path("whole"), 1);
  options.pages = PagesOf::kAll;
  ASSERT_TRUE(Run(options));
  const std::string whole = ResultsIn(folder_.Path("whole"));
  const std::string page = FileText(folder_.Path("whole/pages/inv1/comb1/str2.html"));
  EXPECT_THAT(page, HasSubstr("growing series resistance"));

  options.folder = folder_.Path("threads");
  options.threads = 3;
  ASSERT_TRUE(Run(options));
  EXPECT_EQ(ResultsIn(options.folder), whole);
  EXPECT_EQ(FileText(options.folder + "/pages/inv1/comb1/str2.html"), page);

  options.folder = folder_.Path("resumed");
  options.threads = 1;
  const auto stopped = Run(options, StopAfter(1));
  ASSERT_TRUE(stopped) << MessageOf(stopped);
  EXPECT_TRUE(stopped->interrupted);
  options.start = BatchStart::kResume;
  const auto resumed = Run(options);
  ASSERT_TRUE(resumed) << MessageOf(resumed);
  EXPECT_GE(resumed->rows_before, 1);
  EXPECT_EQ(ResultsIn(options.folder), whole);

  options.start = BatchStart::kNew;
  options.folder = folder_.Path("shards");
  for (int k = 1; k <= 2; ++k) {
    options.shard = {k, 2};
    ASSERT_TRUE(Run(options));
  }
  const auto merged = MergeShards({folder_.Path("shards")}, {folder_.Path("merged")});
  ASSERT_TRUE(merged) << MessageOf(merged);
  EXPECT_EQ(ResultsIn(folder_.Path("merged")), whole);
}

TEST_F(TrendTaskTest, PageOfThePlantShowsTheLossesByPart) {
  ASSERT_TRUE(Run(Into(folder_.Path("out"))));
  const auto written = WritePlantPage(folder_.Path("out"), folder_.Path("plant.html"), "Plant");
  ASSERT_TRUE(written) << MessageOf(written);
  const std::string page = FileText(folder_.Path("plant.html"));
  EXPECT_THAT(
      page, HasSubstr("2 of 4 strings show no cause; 1 needs work: growing series resistance (1)"));
  EXPECT_THAT(page, HasSubstr("Energy lost since the reference days, by part"));
  EXPECT_THAT(page, HasSubstr("power lost now (%)"));
  EXPECT_THAT(page, HasSubstr("2025-01-01 09:00:00 to 2025-04-30 11:00:00"));
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
  counter.Add("b/2", {{100.0, {}, 3.0, 0.0, 0.0, 0.0, 3.0, 0.0}});  // a part is not known
  const PlantLossSummary& summary = counter.summary();
  EXPECT_EQ(summary.plant.rows, 3);
  const PlantLosses& a = summary.groups.at("a");
  EXPECT_DOUBLE_EQ(a.parts.front() / a.weight, 4);
  EXPECT_DOUBLE_EQ(a.parts.back() / a.weight, 4);
  EXPECT_DOUBLE_EQ(a.lost_W, 14);
  EXPECT_DOUBLE_EQ(summary.groups.at("b").parts[1], 300);
  EXPECT_DOUBLE_EQ(summary.plant.parts.back() / summary.plant.weight, 1900.0 / 500);
}

TEST(WholeFiles, AStreamIsRefused) {
  BatchReadOptions reading;
  reading.reading.whole_files = true;
  EXPECT_THAT(MessageOf(OpenBatch({"-"}, reading)), HasSubstr("one a device"));
}

}  // namespace
}  // namespace lyrefit
