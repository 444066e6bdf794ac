#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "batch/synthetic_curves.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RatedPowerBeside, IsTheNumberThatStandsBesideACurve) {
  BatchCurve curve{"s", IvCurve(), {}};
  EXPECT_FALSE(RatedPowerBeside(curve));
  curve.beside["rated_power_W"] = "250.5";
  EXPECT_EQ(RatedPowerBeside(curve), 250.5);
  curve.beside["rated_power_W"] = "unknown";
  EXPECT_FALSE(RatedPowerBeside(curve));
  curve.beside["rated_power_W"] = "250 W";
  EXPECT_FALSE(RatedPowerBeside(curve));
}

// Reads a truth file: line -> {how, fate}.
std::map<int, std::pair<std::string, std::string>> Truth(const std::string& path) {
  std::map<int, std::pair<std::string, std::string>> truth;
  std::ifstream lines(path);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string place, id, how, fate;
    std::getline(std::getline(std::getline(std::getline(fields, place, ','), id, ','), how, ','),
                 fate);
    truth[std::stoi(place)] = {how, fate};
  }
  return truth;
}

TEST(FitTask, EveryBrokenRowOfALoadHasItsReason) {
  const TempFolder folder;
  made::CurvesRequest request;
  request.count = 2000;
  request.points = 20;
  request.broken = 0.9;
  request.out = folder.Path("rows.jsonl");
  request.truth = folder.Path("truth.csv");
  ASSERT_EQ(made::WriteCurves(request), "");
  const std::string out = folder.Path("out");
  FitOptions options = BatchFitOptions();
  options.search.population = 6;
  options.search.iterations = 2;
  ASSERT_TRUE(RunOn(request.out, FitTask(options), Into(out, 2)));

  const auto truth = Truth(request.truth);
  std::map<std::string, int> ways;
  std::ifstream rows(out + "/results.jsonl");
  int line = 0;
  for (std::string text; std::getline(rows, text);) {
    const nlohmann::json row = nlohmann::json::parse(text);
    const auto done = truth.find(++line);
    const std::string status = row["status"];
    const std::string reason = row["reason"].is_string() ? row["reason"] : "";
    const std::string remark = row["remark"].is_string() ? row["remark"] : "";
    if (done == truth.end() || done->second.second == "read") {
      EXPECT_EQ(status, "fine") << text;
      EXPECT_THAT(reason + remark, IsEmpty()) << text;
      continue;
    }
    const auto& [how, fate] = done->second;
    ++ways[how];
    // A copied id is unique if the row before has lost or changed its own.
    const auto before = truth.find(line - 1);
    if (how == "duplicated_id" && before != truth.end()) continue;
    if (fate == "refused") {
      EXPECT_EQ(status, "broken") << how << ": " << text;
    }
    EXPECT_GT((reason + remark).size(), 10U) << how << ": " << text;
    EXPECT_EQ(status == "fine", reason.empty()) << how << ": " << text;
    if (how == "milliampere") {
      EXPECT_EQ(status, "doubtful") << text;
    }
    if (how == "no_id") {
      EXPECT_THAT(remark, HasSubstr("nothing names")) << text;
    }
  }
  EXPECT_EQ(line, 2000);
  EXPECT_EQ(ways.size(), 12U);
}

}  // namespace
}  // namespace lyrefit
