#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch/substrates.h"
#include "lyrefit/read/cells.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST_F(CellTaskTest, RefusesLimitsOfPixelsOutsideTheirRange) {
  PixelOptions pixels;
  pixels.least_jsc_mA_cm2 = kUnknown;
  const auto done = Run({Named("s1", Substrate(5e-3))}, "out", {}, pixels);
  ASSERT_TRUE(done) << done.error().ToString();
  const auto rows = Lines("out/results.jsonl");
  ASSERT_EQ(rows.size(), 4U);
  for (const nlohmann::json& row : rows) {
    EXPECT_EQ(row["status"], "broken");
    EXPECT_EQ(row["reason"], "least-jsc = nan is outside [0, 100]");
  }
}

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
