#include "lyrefit/read/stated_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ReadResultLineTest, ValuesBelongToTheColumnsNamedAbove) {
  std::vector<std::string> names = {"old"};
  TakeColumnNames("Voc (V)", &names);
  EXPECT_THAT(names, ElementsAre("old"));
  TakeColumnNames("Parameter\tb_rev\tb_for\t", &names);
  EXPECT_THAT(names, ElementsAre("b_rev", "b_for"));
  const ResultLine line = ReadResultLine("V_oc [V]:\t1.21\tnone\t1.19", names, "line 3");
  EXPECT_EQ(line.label, "V_oc [V]");
  ASSERT_EQ(line.values.size(), 3U);
  EXPECT_EQ(line.values[0], 1.21);
  EXPECT_TRUE(std::isnan(line.values[1]));
  EXPECT_THAT(line.names, IsEmpty());  // fewer names than values
  EXPECT_THAT(ReadResultLine("V_oc [V]:\t1.21\t1.19", names, "").names,
              ElementsAre("b_rev", "b_for"));
}

TEST(ResultsInTest, TakesResultsOfTheObjectAndOfObjectsOfScalarsInIt) {
  const auto object = nlohmann::json::parse(R"({
      "curve": {"Voc [V]": 1.1, "FF [%]": "78.5", "delay": 3},
      "fit_weight": {"Voc": 20, "Isc": 0, "Pmax": 1},
      "readings": {"Jsc": [1, 2]}, "Eff [%]": 20})");
  const std::vector<StatedResult> results = ResultsIn(object, "cell");
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].label, "FF [%]");
  EXPECT_EQ(results[0].value, 78.5);
  EXPECT_EQ(results[1].label, "Voc [V]");
  EXPECT_EQ(results[1].source, "'cell.curve.Voc [V]'");
  EXPECT_EQ(results[2].label, "Eff [%]");
}

}  // namespace
}  // namespace lyrefit
