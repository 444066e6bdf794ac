#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json CoverageJson(const std::string& arguments) {
  const AppResult result = RunApp("coverage " + arguments + " --json -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

TEST(CoverageVerb, CountsOnTwentySets) {
  const AppResult result = RunApp("coverage --sets 20 --curves 8");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("20 simulated sets"));
  EXPECT_THAT(result.out, HasSubstr("8 curves of 40 points each"));
  EXPECT_EQ(result.out.find("without a usable fit"), std::string::npos) << result.out;
}

TEST(CoverageVerb, GivesTheSameJsonOnAnyNumberOfThreads) {
  json one = CoverageJson("--sets 4 --curves 5 --seed 3 --threads 1");
  json two = CoverageJson("--sets 4 --curves 5 --seed 3 --threads 2");
  RemoveSeconds(&one);
  RemoveSeconds(&two);
  EXPECT_EQ(one, two) << json::diff(one, two).dump();
}

// Twenty sets detect an interval of wrong construction. A measurement of the coverage itself takes
// hundreds of sets.
TEST(CoverageVerb, IntervalsHoldTheTruthMostOfTheTime) {
  const json report = CoverageJson("--sets 20 --curves 10");
  for (const json& parameter : report["parameters"]) {
    if (parameter["counted"] < 15) continue;
    EXPECT_GE(parameter["covered"].get<double>() / parameter["counted"].get<double>(), 0.7)
        << parameter["symbol"];
  }
}

TEST(CoverageVerb, FindsAHiddenErrorOfTheTemperatureSensor) {
  const json report =
      CoverageJson("--sets 10 --curves 12 --temperature-error 3 --temperature-offset");
  const json& offset = report["parameters"].back();
  EXPECT_EQ(offset["symbol"], "dT");
  if (offset["counted"] > 5) {
    EXPECT_GE(offset["covered"].get<double>() / offset["counted"].get<double>(), 0.6);
  }
}

TEST(CoverageVerb, RefusesWhatCannotBeSimulated) {
  EXPECT_THAT(RunApp("coverage --set Iph=8").err, HasSubstr("no value for Is1"));
  EXPECT_THAT(RunApp("coverage --model td --sets 1").err, HasSubstr("expected sd or dd"));
  EXPECT_EQ(RunApp("coverage --sets 0").exit_code, 1);
}

TEST(CoverageVerb, WritesTheParametersAsATable) {
  const AppResult result = RunApp("coverage --sets 2 --curves 5 --csv -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::StartsWith("parameter,name,unit,fitted,not_identifiable,"));
  EXPECT_THAT(result.out, HasSubstr("\nRs,R_s,ohm,2,"));
}

}  // namespace
}  // namespace lyrefit
