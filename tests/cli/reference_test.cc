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
const std::string kQuickReference = " --effects nonohmic_shunt --no-held-out ";

TEST(DiagnoseReference, ComparesASweepWithItsHistory) {
  const AppResult result = RunApp("diagnose " + kNow + " --reference " + kSweeps + kQuickReference);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("series resistance +"));
  EXPECT_THAT(result.out, HasSubstr("13: unlike the other reference sweeps"));
  EXPECT_THAT(result.out, HasSubstr("diagnosis of sweep_now"));
  EXPECT_THAT(result.out, HasSubstr("miss alike"));
}

TEST(DiagnoseReference, WritesJson) {
  const AppResult result =
      RunApp("diagnose " + kNow + " --reference " + kSweeps + kQuickReference + "--json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json j = json::parse(result.out);
  EXPECT_EQ(j["comparison"]["causes"][0]["id"], "series_resistance");
  EXPECT_NEAR(j["comparison"]["causes"][0]["size"], 8, 1);
  EXPECT_EQ(j["diagnosis"]["name"], "sweep_now");
}

TEST(DiagnoseModule, FindsTheOutlierSweep) {
  const AppResult result = RunApp("diagnose " + kSweeps + " --module --brief");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("13: The sweep differs from the 19 sweeps nearest to it"));
  EXPECT_THAT(result.out, HasSubstr("outliers: 1 of 20 sweeps"));
  const AppResult as_table = RunApp("diagnose " + kSweeps + " --module --csv -");
  EXPECT_THAT(as_table.out, ::testing::StartsWith("sweep,differs,p_value,cause,size,"));
  const AppResult as_json = RunApp("diagnose " + kSweeps + " --module --json -");
  EXPECT_EQ(json::parse(as_json.out)["sweeps"][0]["name"], "13");
}

}  // namespace
}  // namespace lyrefit
