// Field measurements that are not part of the project. Built only if LYREFIT_FIELD_DATA is set to
// their folder.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kMeasured[] = LYREFIT_FIELD_DATA_DIR;

std::vector<fs::path> TablesUnder(const fs::path& folder) {
  std::vector<fs::path> tables;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.extension() != ".csv") continue;
    const std::string name = path.filename().string();
    if (name == "curves.csv" || name == "index.csv" || name == "labels.csv") continue;
    tables.push_back(path);
  }
  std::sort(tables.begin(), tables.end());
  return tables;
}

bool SaysThatTheSignWasTurned(const IvCurve& curve) {
  return std::any_of(curve.assumptions.begin(), curve.assumptions.end(), [](const Assumption& one) {
    return one.sentence.find("sign") != std::string::npos;
  });
}

TEST(FieldDataTest, EverySingleCurveIsReadWithItsSign) {
  const fs::path root(kMeasured);
  for (const char* folder : {"field", "benchmark"}) {
    const std::vector<fs::path> tables = TablesUnder(root / folder);
    EXPECT_GE(tables.size(), 8U);
    for (const fs::path& table : tables) {
      SCOPED_TRACE(table);
      ReadOptions options;  // file with a lit and a dark sweep: the first
      if (table.filename() == "isfh_litdark.csv") options.curve = 0;
      const auto curve = ReadCurve(table.string(), options);
      ASSERT_TRUE(curve) << curve.error().ToString();
      EXPECT_FALSE(SaysThatTheSignWasTurned(*curve));
    }
  }
}

TEST(FieldDataTest, ACurveOfASetIsReadByItsNumber) {
  const fs::path root(kMeasured);
  const std::string path = (root / "field/sdle_ddiv_timeseries/curves.csv").string();
  EXPECT_FALSE(ReadCurve(path));
  ReadOptions options;
  for (options.curve = 0; *options.curve < 60; ++*options.curve) {
    SCOPED_TRACE(*options.curve);
    const auto curve = ReadCurve(path, options);
    ASSERT_TRUE(curve) << curve.error().ToString();
    EXPECT_EQ(curve->size(), 41U);
    EXPECT_FALSE(SaysThatTheSignWasTurned(*curve));
  }
}

TEST(FieldDataTest, AllContestCurvesAreRead) {
  int curves = 0;
  for (const char* name : {"case1", "case2", "case3a", "case3b", "case3c", "case3d"}) {
    SCOPED_TRACE(name);
    const fs::path path = fs::path(kMeasured) / "ivcurves" / (std::string(name) + ".json");
    const auto set = ReadCurveSet(path.string());
    ASSERT_TRUE(set) << set.error().ToString();
    for (const IvCurve& curve : set->curves) {
      EXPECT_GT(curve.conditions.cells_in_series, 1);
      EXPECT_FALSE(SaysThatTheSignWasTurned(curve));
      ++curves;
    }
  }
  EXPECT_EQ(curves, 264);
}

TEST(FieldDataTest, EveryPanelCaseIsReadWholeOrSweepBySweep) {
  int cases = 0;
  for (const fs::path& table : TablesUnder(fs::path(kMeasured) / ".." / "panel" / "cases")) {
    SCOPED_TRACE(table);
    ++cases;
    ReadOptions options;
    auto curve = ReadCurve(table.string());
    if (curve) {
      EXPECT_FALSE(SaysThatTheSignWasTurned(*curve));
      continue;
    }
    EXPECT_THAT(curve.error().message, ::testing::HasSubstr("--curve INDEX"));
    for (options.curve = 0; (curve = ReadCurve(table.string(), options)); ++*options.curve) {
      EXPECT_FALSE(SaysThatTheSignWasTurned(*curve));
      EXPECT_GE(curve->size(), 10U);
      // The conditions are those of the sweep, not the nominal ones.
      EXPECT_NEAR(curve->conditions.irradiance_W_m2, curve->irradiance_W_m2.front(),
                  0.02 * curve->irradiance_W_m2.front());
    }
    EXPECT_GE(*options.curve, 2);
  }
  EXPECT_EQ(cases, 111);
}

}  // namespace
}  // namespace lyrefit
