// Checks that the project's own data folders contain what data/README.md states.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/file.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> DataFolders() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(LYREFIT_DATA_DIR)) {
    if (entry.is_directory() && fs::exists(entry.path() / "curve.csv")) {
      folders.push_back(entry.path());
    }
  }
  return folders;
}

nlohmann::json ReadJson(const fs::path& path) {
  const auto text = ReadTextFile(path.string(), 1 << 20);
  EXPECT_TRUE(text) << path;
  const auto json = ParseJson(*text, path.string());
  EXPECT_TRUE(json) << json.error().ToString();
  return *json;
}

void ExpectBounds(const nlohmann::json& bounds) {
  std::set<std::string> names;
  for (const auto& [name, range] : bounds.items()) {
    names.insert(name);
    ASSERT_EQ(range.size(), 2U);
    EXPECT_LT(range[0].get<double>(), range[1].get<double>()) << name;
    EXPECT_GE(range[0].get<double>(), 0) << name;
  }
  EXPECT_THAT(names, ::testing::ElementsAre("Iph", "Is", "Rs", "Rsh", "n"));
}

TEST(DataFoldersTest, BenchmarkCurvesAreAsPublished) {
  const struct {
    const char* name;
    std::size_t points;
    int cells;
    double temperature_C;
    double first_V, first_A, last_V, last_A;
  } kCases[] = {{"rtc_france", 26, 1, 33, -0.2057, 0.764, 0.59, -0.21},
                {"pwp201", 25, 36, 45, 0.1248, 1.0315, 17.4885, -0.303},
                {"stm6_40_36", 20, 36, 51, 0, 1.663, 21.02, 0},
                {"stp6_120_36", 24, 36, 55, 0, 7.48, 19.21, 0},
                {"msx60", 15, 36, 25, 0, 3.8, 21.1, 0}};
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.name);
    const auto curve = ReadCurve(std::string(LYREFIT_DATA_DIR "/") + c.name);
    ASSERT_TRUE(curve) << curve.error().ToString();
    EXPECT_EQ(curve->name, c.name);
    ASSERT_EQ(curve->size(), c.points);
    EXPECT_EQ(curve->conditions.cells_in_series, c.cells);
    EXPECT_EQ(curve->conditions.cell_temperature_K, c.temperature_C + kZeroCelsius_K);
    EXPECT_EQ(curve->conditions.irradiance_W_m2, 1000);
    EXPECT_EQ(curve->voltage_V.front(), c.first_V);
    EXPECT_EQ(curve->current_A.front(), c.first_A);
    EXPECT_EQ(curve->voltage_V.back(), c.last_V);
    EXPECT_EQ(curve->current_A.back(), c.last_A);
  }
}

TEST(DataFoldersTest, EveryFolderSaysAllTheReaderNeeds) {
  ASSERT_GE(DataFolders().size(), 5U);
  for (const fs::path& folder : DataFolders()) {
    SCOPED_TRACE(folder);
    const auto curve = ReadCurve(folder.string());
    ASSERT_TRUE(curve) << curve.error().ToString();
    EXPECT_EQ(curve->name, folder.filename().string());
    EXPECT_THAT(SentencesOf(curve->assumptions), ::testing::IsEmpty());
    EXPECT_TRUE(fs::exists(folder / "about.md"));
  }
}

TEST(DataFoldersTest, BoundsFilesHoldAllFiveRanges) {
  int files = 0;
  for (const fs::path& folder : DataFolders()) {
    for (const char* name : {"bounds-literature.json", "bounds-paper.json"}) {
      if (!fs::exists(folder / name)) continue;
      SCOPED_TRACE(folder / name);
      ++files;
      ExpectBounds(ReadJson(folder / name));
    }
  }
  EXPECT_EQ(files, 6);
}

TEST(DataFoldersTest, ExpectedValuesNameModelObjectiveAndConstants) {
  for (const fs::path& folder : DataFolders()) {
    SCOPED_TRACE(folder);
    const nlohmann::json rows = ReadJson(folder / "expected.json");
    ASSERT_FALSE(rows.empty());
    for (const nlohmann::json& row : rows) {
      EXPECT_THAT((std::set<std::string>{"SD", "DD", "TD"}), ::testing::Contains(row.at("model")));
      EXPECT_THAT((std::set<std::string>{"measured-current", "solved-current"}),
                  ::testing::Contains(row.at("objective")));
      EXPECT_TRUE(FromText<ConstantSet>(row.at("constants").get<std::string>()));
      EXPECT_GT(row.at("rmse_A").get<double>(), 0);
      EXPECT_EQ(row.at("relative_tolerance"), 1e-9);
      ExpectBounds(row.at("bounds"));
    }
  }
}

}  // namespace
}  // namespace lyrefit
