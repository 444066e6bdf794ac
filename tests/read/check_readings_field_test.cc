// Real curves, for which no finding may be reported. Built only if LYREFIT_FIELD_DATA is set to
// their folder.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kField[] = LYREFIT_FIELD_DATA_DIR;

// Every curve of every readable table and JSON file below `folder`.
std::vector<IvCurve> CurvesUnder(const fs::path& folder) {
  std::vector<IvCurve> curves;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.extension() != ".csv" || path.filename() == "index.csv") continue;
    if (const auto curve = ReadCurve(path.string())) {
      curves.push_back(*curve);
      continue;
    }
    const bool is_set = path.filename() == "curves.csv";
    const auto set = ReadCurveSet((is_set ? path.parent_path() : path).string());
    if (set) curves.insert(curves.end(), set->curves.begin(), set->curves.end());
  }
  return curves;
}

TEST(CheckReadingsFieldTest, NothingRealIsRefusedOrDoubtedButCellsNobodyCounted) {
  int seen = 0, cells_unknown = 0;
  for (const char* folder : {"field", "benchmark"}) {
    for (const IvCurve& curve : CurvesUnder(fs::path(kField) / folder)) {
      SCOPED_TRACE(curve.source + " " + curve.name);
      ++seen;
      for (const ReadingFinding& finding : CheckReadings(curve)) {
        EXPECT_FALSE(finding.refuse) << finding.sentence;
        EXPECT_EQ(finding.id, "cells") << finding.sentence;
        EXPECT_FALSE(curve.cells_known);
        ++cells_unknown;
      }
    }
  }
  EXPECT_GT(seen, 1900);
  EXPECT_LT(cells_unknown, 100);
}

TEST(CheckReadingsFieldTest, CleanCurvesHaveNeitherDoubtsNorSteps) {
  std::ifstream labels(fs::path(kField) / "field/single/labels.csv");
  int clean = 0;
  for (std::string line; std::getline(labels, line);) {
    const std::size_t comma = line.find(',');
    if (line.compare(comma, 7, ",clean,") != 0) continue;
    SCOPED_TRACE(line);
    const std::string file = line.substr(0, comma) + ".csv";
    const auto curve = ReadCurve((fs::path(kField) / "field/single" / file).string());
    ASSERT_TRUE(curve);
    EXPECT_THAT(CheckReadings(*curve), ::testing::IsEmpty());
    EXPECT_FALSE(FindStep(*curve));
    ++clean;
  }
  EXPECT_GT(clean, 35);
}

// Their devices are invented. Nobody states a technology, and some have more than silicon gives.
TEST(CheckReadingsFieldTest, ContestCurvesAreDoubtedForTheirVoltageAlone) {
  for (const char* name : {"case1", "case2", "case3a", "case3b", "case3c", "case3d"}) {
    const auto set =
        ReadCurveSet((fs::path(kField) / "ivcurves" / (std::string(name) + ".json")).string());
    ASSERT_TRUE(set);
    for (const IvCurve& curve : set->curves) {
      const KeyPoints points = FindKeyPoints(curve.voltage_V, curve.current_A);
      for (const ReadingFinding& finding : CheckReadings(curve)) {
        EXPECT_EQ(finding.id, "technology") << finding.sentence;
        EXPECT_FALSE(finding.refuse);
        EXPECT_GT(points.open_circuit_voltage_V / curve.conditions.cells_in_series, 0.75);
      }
    }
  }
}

TEST(FindStepFieldTest, ConductingBypassDiodesAreSteps) {
  for (const char* name : {"ddiv_IV_step3", "nist01_fault_0652", "wbw_snow_0331T1910",
                           "wbw_snow_0331T1540", "wbw_snow_0401T1300"}) {
    SCOPED_TRACE(name);
    const auto curve =
        ReadCurve((fs::path(kField) / "field/single" / (std::string(name) + ".csv")).string());
    ASSERT_TRUE(curve);
    const auto step = FindStep(*curve);
    ASSERT_TRUE(step);
    EXPECT_GT(step->voltage_V, 20);
    EXPECT_LT(step->voltage_V, 27);
  }
}

}  // namespace
}  // namespace lyrefit
