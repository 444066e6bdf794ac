#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kSweeps = "'" + DataFolder("diagnosis/sweeps") + "'";
const std::string kNow = "'" + DataFolder("diagnosis/sweep_now.csv") + "'";
const std::string kQuickHealthy = " --effects nonohmic_shunt --draws 200 --no-held-out ";

TEST(DiagnoseHealthy, ComparesASweepWithItsPast) {
  const AppResult result = RunApp("diagnose " + kNow + " --healthy " + kSweeps + kQuickHealthy);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("series resistance +"));
  EXPECT_THAT(result.out, HasSubstr("13: unlike the other healthy sweeps"));
  EXPECT_THAT(result.out, HasSubstr("diagnosis of sweep_now"));
  EXPECT_THAT(result.out, HasSubstr("miss alike"));
}

TEST(DiagnoseHealthy, WritesJson) {
  const AppResult result =
      RunApp("diagnose " + kNow + " --healthy " + kSweeps + kQuickHealthy + "--json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json j = json::parse(result.out);
  EXPECT_EQ(j["comparison"]["causes"][0]["id"], "series_resistance");
  EXPECT_NEAR(j["comparison"]["causes"][0]["size"], 8, 1);
  EXPECT_EQ(j["diagnosis"]["name"], "sweep_now");
}

TEST(DiagnoseModule, FindsTheOddSweep) {
  const AppResult result = RunApp("diagnose " + kSweeps + " --module --brief");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("13: Unlike the 19 sweeps nearest to it"));
  EXPECT_THAT(result.out, HasSubstr("1 of 20 sweeps odd"));
  const AppResult as_table = RunApp("diagnose " + kSweeps + " --module --csv -");
  EXPECT_THAT(as_table.out, ::testing::StartsWith("sweep,differs,p_value,cause,size,"));
  const AppResult as_json = RunApp("diagnose " + kSweeps + " --module --json -");
  EXPECT_EQ(json::parse(as_json.out)["sweeps"][0]["name"], "13");
}

TEST(DiagnoseHealthy, RefusesWithOneSentence) {
  ExpectRefusals(
      "diagnose ",
      {
          {kNow + " --healthy " + kNow, "0 healthy sweeps can be used"},
          {kNow + " --healthy no_such_file.csv", "no_such_file.csv: the file does not exist"},
          {kNow + " --healthy " + kSweeps + " --module", "only one of --healthy and --module"},
          {kSweeps + " --healthy " + kSweeps, "compares one sweep"},
          {kNow + " --module", "takes 5 or more"},
          {kSweeps + " --module --plot x.svg", "--plot and --extend are not for --module"},
          {kNow + " --healthy " + kSweeps + " --answers x.json", "--answers"},
          {"'" + DataFolder("diagnosis/shaded_module.csv") + "' --healthy " + kSweeps, "96 cells"},
      });
}

}  // namespace
}  // namespace lyrefit
