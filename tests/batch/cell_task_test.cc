#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "../error_of.h"
#include "lyrefit/read/cells.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kArea_cm2 = 0.25;
const std::string kSidecar =
    R"({"cells_in_series": 1, "area_cm2": 0.25, "nominal_irradiance_Wm2": 1000,)"
    R"( "nominal_temperature_C": 25})";

// Current of a diode of n = 1.5 at a voltage; 0 of photocurrent in the dark.
double Diode_A(double photocurrent_A, double voltage_V) {
  return photocurrent_A - 1e-11 * std::expm1(voltage_V / (1.5 * 0.0256926));
}

// A column of currents and its name.
struct TestColumn {
  std::string name;
  std::function<double(double voltage_V)> current_A;
};

std::string TableOf(const std::vector<TestColumn>& columns) {
  std::string text = "voltage (V)";
  for (const TestColumn& column : columns) text += ",Current (A)_" + column.name;
  for (int k = -10; k <= 80; ++k) {
    const double voltage_V = 0.01 * k;
    text += fmt::format("\n{:.2f}", voltage_V);
    for (const TestColumn& column : columns)
      text += fmt::format(",{:.9g}", column.current_A(voltage_V));
  }
  return text + "\n";
}

TestColumn Lit(const std::string& pixel, const std::string& direction, double photocurrent_A) {
  return {pixel + "_" + direction + "_light",
          [photocurrent_A](double v) { return Diode_A(photocurrent_A, v); }};
}

// Four pixels: a and b work (a also in the dark), c is shorted, d is dead.
std::string Substrate(double photocurrent_A) {
  return TableOf({Lit("a", "forward", photocurrent_A),
                  Lit("a", "reverse", 1.02 * photocurrent_A),
                  {"a_forward_dark", [](double v) { return Diode_A(0, v); }},
                  Lit("b", "forward", 0.9 * photocurrent_A),
                  Lit("b", "reverse", 0.89 * photocurrent_A),
                  {"c_forward_light", [](double v) { return 1e-3 - 0.05 * v; }},
                  {"d_forward_light", [](double v) { return 1e-9 - 1e-8 * v; }}});
}

class CellTaskTest : public testing::Test {
 protected:
  Expected<BatchSummary> Run(const std::vector<std::string>& inputs, const std::string& out,
                             Shard shard = {}, const PixelOptions& pixels = {}) {
    BatchReadOptions reading;
    reading.shard = shard;
    reading.reading.whole_cells = true;
    auto source = OpenBatch(inputs, reading);
    if (!source) return tl::unexpected(source.error());
    BatchOptions options = Into(folder_.Path(out));
    options.shard = shard;
    CellOptions cell;
    cell.fit = false;
    return RunBatch(source->get(), CellTask(cell, pixels), options);
  }
  std::string Named(const std::string& name, const std::string& text) {
    folder_.Write(name + ".json", kSidecar);
    return folder_.Write(name + ".csv", text);
  }
  std::vector<nlohmann::json> Lines(const std::string& file) {
    std::istringstream lines(FileText(folder_.Path(file)));
    std::vector<nlohmann::json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  std::string Results(const std::string& out) {
    return ResultsIn(folder_.Path(out)) + FileText(folder_.Path(out) + "/samples.csv") +
           FileText(folder_.Path(out) + "/samples.jsonl");
  }

  const TempFolder folder_;
};

TEST_F(CellTaskTest, APixelIsARowWithAllItsMeasurements) {
  const auto done = Run({Named("s1", Substrate(5e-3))}, "out");
  ASSERT_TRUE(done) << done.error().ToString();
  const auto rows = Lines("out/results.jsonl");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_THAT(rows[0]["id"].get<std::string>(), HasSubstr("/s1/a"));
  EXPECT_EQ(rows[0]["state"], "working");
  EXPECT_EQ(rows[0]["sweeps"], 3);
  EXPECT_EQ(rows[0]["direction"], "reverse");
  EXPECT_NEAR(rows[0]["forward_jsc_mA_cm2"], 1e3 * 5e-3 / kArea_cm2, 1e-6);
  EXPECT_NEAR(rows[0]["reverse_jsc_mA_cm2"], 1.02 * 1e3 * 5e-3 / kArea_cm2, 1e-6);
  EXPECT_NEAR(rows[0]["Isc_A"], 1.02 * 5e-3, 1e-8);  // of the direction of more power
  EXPECT_EQ(rows[0]["hysteresis"], "normal");
  EXPECT_NEAR(rows[0]["n_dark"], 1.5, 0.01);
  EXPECT_EQ(rows[1]["direction"], "forward");
  EXPECT_EQ(rows[1]["hysteresis"], "inverted");
  EXPECT_EQ(rows[2]["state"], "shorted");
  EXPECT_EQ(rows[2]["status"], "not usable");
  EXPECT_EQ(rows[3]["state"], "dead");
}

TEST_F(CellTaskTest, ASampleHasItsStatisticsChampionAndYield) {
  const std::string lone = Named("t_1", TableOf({Lit("t", "forward", 6e-3)}));
  const std::string other = Named("t_2", TableOf({Lit("t", "forward", 4e-3)}));
  const auto done = Run({Named("s1", Substrate(5e-3)), lone, other}, "out");
  ASSERT_TRUE(done) << done.error().ToString();
  ASSERT_EQ(done->samples.size(), 2U);
  const SampleSummary& sample = done->samples[0];
  EXPECT_EQ(sample.pixels, 4);
  EXPECT_EQ(sample.working(), 2);
  EXPECT_EQ(sample.yield(), 0.5);
  EXPECT_THAT(sample.not_working, ElementsAre("c: shorted", "d: dead"));
  ASSERT_EQ(sample.directions.size(), 2U);
  EXPECT_THAT(sample.directions[0].champion, HasSubstr("s1/a"));
  EXPECT_EQ(sample.senses.at("normal"), 1);
  EXPECT_EQ(sample.senses.at("inverted"), 1);
  const Quartiles& jsc = sample.directions[0].quantities[1];
  EXPECT_EQ(jsc.count, 2);
  EXPECT_NEAR(jsc.median, 19, 1e-6);  // of 18 and 20
  EXPECT_NEAR(jsc.low, 18.5, 1e-6);
  EXPECT_NEAR(jsc.high, 19.5, 1e-6);
  const SampleSummary& files = done->samples[1];
  EXPECT_EQ(files.name.substr(files.name.rfind('/') + 1), "t");
  EXPECT_EQ(files.pixels, 2);
  // The long name of the folder breaks lines anywhere.
  const std::string text =
      std::regex_replace(BatchText(*done), std::regex("\\s+"), std::string(" "));
  EXPECT_THAT(text, HasSubstr("2 of 4 work, yield 50 %"));
  EXPECT_THAT(text, HasSubstr("c: shorted; d: dead"));
  const auto rows = Lines("out/samples.jsonl");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1]["direction"], "reverse");
  EXPECT_EQ(rows[1]["shorted"], 1);
}

TEST_F(CellTaskTest, ShardsMergeToTheBytesOfOneRun) {
  const std::vector<std::string> files = {Named("s1", Substrate(5e-3)),
                                          Named("s2", Substrate(4e-3))};
  ASSERT_TRUE(Run(files, "whole"));
  for (int k = 1; k <= 3; ++k) {
    const auto shard = Run(files, "shards", {k, 3});
    ASSERT_TRUE(shard) << shard.error().ToString();
  }
  const auto merged = MergeShards({folder_.Path("shards")}, {folder_.Path("merged"), false});
  ASSERT_TRUE(merged) << merged.error().ToString();
  EXPECT_EQ(Results("merged"), Results("whole"));
  EXPECT_EQ(merged->samples.size(), 2U);
  EXPECT_THAT(merged->working_pixel, HasSubstr("A pixel works if"));
}

TEST_F(CellTaskTest, TheCriterionIsAnOption) {
  PixelOptions pixels;
  pixels.least_efficiency_percent = 90;
  const auto done = Run({Named("s1", Substrate(5e-3))}, "out", {}, pixels);
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->samples[0].working(), 0);
  EXPECT_THAT(done->samples[0].not_working,
              ElementsAre("a: weak", "b: weak", "c: shorted", "d: dead"));
  EXPECT_THAT(BatchText(*done), HasSubstr("Weak: efficiency below 90 %"));
}

TEST_F(CellTaskTest, WhatCannotBeReadIsCountedAndNamed) {
  const std::string bad = folder_.Write("bad.csv", "voltage (V),current (A)\n0,1\n");
  const auto done = Run({bad, Named("s1", TableOf({Lit("a", "forward", 5e-3)}))}, "out");
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->rows, 2);
  EXPECT_THAT(done->samples[0].not_working, ElementsAre("bad: broken"));
  EXPECT_EQ(done->samples[0].yield(), 0);
}

TEST(SampleOfCell, IsTheIdWithoutThePixel) {
  for (const auto& [id, where, sample] : std::vector<std::array<std::string, 3>>{
           {"batch7/ox3_px2", "batch7/ox3_px2.csv", "batch7/ox3"},
           {"pers1_a", "pers1_a.csv", "pers1"},
           {"og1 cell 12", "og1 cell 12.csv", "og1"},
           {"ox3/pixel1", "ox3/pixel1.csv", "ox3"},
           {"ox3/a", "ox3.txt", "ox3"},
           {"ox3/Sample 1 A", "ox3.txt", "ox3/Sample 1"},
           {"ox3/1a substr1 20250519", "ox3.txt", "ox3"},
           {"batch7/reference", "batch7/reference.csv", "batch7/reference"},
           {"batch7/scan_2023", "batch7/scan_2023.csv", "batch7/scan_2023"},
           {"site/cell", "rows.jsonl:3", "site"},
           {"alone", "rows.jsonl:3", "alone"}}) {
    EXPECT_EQ(SampleOfCell(id, where), sample) << id;
  }
}

TEST(CellOfCurve, IsTheNameWithoutLightAndDirection) {
  EXPECT_EQ(CellOfCurve("a dark"), "a");
  EXPECT_EQ(CellOfCurve("Sample 1 A"), "Sample 1 A");
  EXPECT_EQ(CellOfCurve("light"), "");
  EXPECT_EQ(CellOfCurve("Current (A)_a_forward_dark"), "a");
  EXPECT_EQ(CellOfCurve("Pixel 1 J (A/cm^2)"), "1");
  EXPECT_EQ(CellOfCurve("12_3_reverse.txt"), "12 3");
}

}  // namespace
}  // namespace lyrefit
