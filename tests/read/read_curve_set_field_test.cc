// Measured sets that are not part of the project. Built only if LYREFIT_FIELD_DATA is set to their
// folder.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "lyrefit/base/file.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot(LYREFIT_FIELD_DATA_DIR);

TEST(FieldSetTest, FoldersOfManyCurvesAreRead) {
  const struct {
    const char* folder;
    std::size_t curves, points;
    int cells;
    bool irradiance_known, temperature_known;
  } kSets[] = {{"sandia_pvue125", 578, 32335, 36, true, true},
               {"nist_ground_2015-07-20", 241, 22973, 60, true, true},
               {"nist_ground_2015-07-01", 938, 89576, 60, false, false},
               {"sdle_ddiv_timeseries", 60, 2460, 1, false, false}};
  for (const auto& expected : kSets) {
    SCOPED_TRACE(expected.folder);
    const std::string path = (kRoot / "field" / expected.folder).string();
    EXPECT_TRUE(HoldsCurveSet(path));
    const auto set = ReadCurveSet(path);
    ASSERT_TRUE(set) << set.error().ToString();
    EXPECT_EQ(set->name, expected.folder);
    EXPECT_EQ(set->curves.size() + set->rejected.size(), expected.curves);
    std::size_t points = 0;
    for (const RejectedCurve& curve : set->rejected) {
      ADD_FAILURE() << curve.id << ": " << curve.error.ToString();
    }
    for (const IvCurve& curve : set->curves) {
      points += curve.size();
      EXPECT_EQ(curve.conditions.cells_in_series, expected.cells);
      EXPECT_EQ(curve.irradiance_known, expected.irradiance_known) << curve.name;
      EXPECT_EQ(curve.temperature_known, expected.temperature_known) << curve.name;
      for (const std::string& sentence : SentencesOf(curve.assumptions)) {
        EXPECT_EQ(sentence.find("load sign"), std::string::npos) << curve.name;
      }
    }
    EXPECT_EQ(points, expected.points);
  }
}

TEST(FieldSetTest, TheIndexGivesEveryCurveItsConditions) {
  const auto set = ReadCurveSet((kRoot / "field" / "sandia_pvue125").string());
  ASSERT_TRUE(set) << set.error().ToString();
  const auto found = std::find_if(set->curves.begin(), set->curves.end(),
                                  [](const IvCurve& curve) { return curve.name == "8"; });
  ASSERT_NE(found, set->curves.end());
  EXPECT_EQ(found->conditions.irradiance_W_m2, 641.106);
  EXPECT_DOUBLE_EQ(found->conditions.cell_temperature_K, 38.9946 + 273.15);
  EXPECT_EQ(found->notes.isc_tempco_A_per_K, 0.0054);
}

TEST(FieldSetTest, EveryPanelFamilyIsASetOfItsSweeps) {
  const fs::path panel = kRoot / ".." / "panel";
  const auto text = ReadTextFile((panel / "labels.json").string(), 1 << 26);
  ASSERT_TRUE(text);
  const auto labels = nlohmann::json::parse(*text);
  int families = 0;
  for (const auto& [name, label] : labels.items()) {
    SCOPED_TRACE(name);
    const std::string path = (panel / "cases" / (name + ".csv")).string();
    const std::string kind = label["kind"];
    const bool family = kind == "famG" || kind == "famGT";
    EXPECT_EQ(HoldsCurveSet(path), family || kind == "dark");
    if (!family) continue;
    ++families;
    const auto set = ReadCurveSet(path);
    ASSERT_TRUE(set) << set.error().ToString();
    EXPECT_GE(set->curves.size(), 4U);
    EXPECT_TRUE(set->rejected.empty());
    for (const IvCurve& curve : set->curves) {
      EXPECT_TRUE(curve.irradiance_known);
      EXPECT_TRUE(curve.temperature_known);
      EXPECT_NEAR(curve.conditions.irradiance_W_m2, curve.irradiance_W_m2.front(),
                  0.02 * curve.irradiance_W_m2.front());
      EXPECT_TRUE(curve.assumptions.empty()) << curve.assumptions.front().sentence;
    }
  }
  EXPECT_EQ(families, 35);
}

TEST(FieldSetTest, ContestFilesAreSets) {
  std::size_t curves = 0;
  for (const char* name : {"case1", "case2", "case3a", "case3b", "case3c", "case3d"}) {
    SCOPED_TRACE(name);
    const std::string path = (kRoot / "ivcurves" / (std::string(name) + ".json")).string();
    EXPECT_TRUE(HoldsCurveSet(path));
    const auto set = ReadCurveSet(path);
    ASSERT_TRUE(set) << set.error().ToString();
    EXPECT_TRUE(set->rejected.empty());
    EXPECT_EQ(set->curves.front().name, "1");
    curves += set->curves.size();
  }
  EXPECT_EQ(curves, 264U);
}

TEST(FieldSetTest, AFolderOfTablesIsASet) {
  const auto set = ReadCurveSet((kRoot / "field" / "hzb_perovskite_batch1").string());
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_EQ(set->curves.size(), 6U);
  EXPECT_EQ(set->curves.front().name, "pixel_b_for");
}

}  // namespace
}  // namespace lyrefit
