#include "batch/synthetic_curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "temp_folder.h"

namespace made {
namespace {

using lyrefit::FileText;
using lyrefit::TempFolder;

using testing::AllOf;
using testing::Ge;
using testing::Le;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct Load {
  std::vector<std::string> rows, truth;
};

Load Make(std::int64_t count, Shape shape, const TempFolder& folder) {
  CurvesRequest request;
  request.count = count;
  request.shape = shape;
  request.out = folder.Path("rows");
  request.truth = folder.Path("truth.csv");
  EXPECT_EQ(WriteCurves(request), "");
  return {Lines(FileText(folder.Path("rows"))), Lines(FileText(folder.Path("truth.csv")))};
}

TEST(SyntheticCurves, RowsDoNotDependOnHowManyThereAre) {
  const TempFolder folder;
  const Load few = Make(50, Shape::kJsonLines, folder), many = Make(90, Shape::kJsonLines, folder);
  ASSERT_EQ(few.rows.size(), 50u);
  EXPECT_TRUE(std::equal(few.rows.begin(), few.rows.end(), many.rows.begin()));
}

TEST(SyntheticCurves, OneRowInAHundredIsBrokenInOneOfTwelveWays) {
  const TempFolder folder;
  const Load load = Make(10'000, Shape::kJsonLines, folder);
  std::map<std::string, int> ways;
  int broken = 0;
  for (std::size_t k = 1; k < load.truth.size(); ++k) {
    std::istringstream fields(load.truth[k]);
    std::string line, id, how, fate;
    std::getline(std::getline(std::getline(std::getline(fields, line, ','), id, ','), how, ','),
                 fate);
    if (how == "reversed") continue;
    ++ways[how];
    ++broken;
    const std::string& row = load.rows[std::stoul(line) - 1];
    if (!id.empty()) {
      EXPECT_THAT(row, testing::HasSubstr(id));
    }
    const bool parses = nlohmann::json::accept(row);
    EXPECT_EQ(parses, how != "cut" && how != "nan") << row;
  }
  EXPECT_EQ(ways.size(), 12u);
  EXPECT_THAT(broken, AllOf(Ge(65), Le(140)));
}

TEST(SyntheticCurves, RowsThatAreNotBrokenFallFromShortCircuitToTheOpenCircuit) {
  const TempFolder folder;
  const Load load = Make(40, Shape::kJsonLines, folder);
  const auto row = nlohmann::json::parse(load.rows[0]);
  const auto voltage = row["voltage_V"].get<std::vector<double>>();
  const auto current = row["current_A"].get<std::vector<double>>();
  ASSERT_EQ(voltage.size(), 50u);
  EXPECT_TRUE(std::is_sorted(voltage.begin(), voltage.end()));
  EXPECT_NEAR(voltage.front(), 0, 0.01);
  EXPECT_NEAR(current.back(), 0, 0.02 * current.front());
  double power = 0;
  for (int k = 0; k < 50; ++k) power = std::max(power, voltage[k] * current[k]);
  const double suns = row["irradiance_Wm2"].get<double>() / 1000;
  EXPECT_NEAR(power / suns, row["rated_power_W"].get<double>(), 0.25 * power / suns);
}

TEST(SyntheticCurves, CsvHoldsTheSameCurves) {
  const TempFolder folder;
  const Load json = Make(3, Shape::kJsonLines, folder), csv = Make(3, Shape::kCsv, folder);
  ASSERT_EQ(csv.rows.size(), 4u);
  const auto row = nlohmann::json::parse(json.rows[0]);
  EXPECT_THAT(csv.rows[1], testing::StartsWith(row["id"].get<std::string>() + ","));
  const std::size_t last = csv.rows[1].rfind(',');
  std::istringstream readings(csv.rows[1].substr(last + 1));
  for (const auto& current : row["current_A"]) {
    double value = 0;
    readings >> value;
    EXPECT_EQ(value, current.get<double>());
  }
}

TEST(SyntheticCurves, AFolderThatIsNotThereIsSaid) {
  CurvesRequest request;
  request.out = "/no/such/folder/rows";
  EXPECT_EQ(WriteCurves(request), "cannot write /no/such/folder/rows");
}

}  // namespace
}  // namespace made
