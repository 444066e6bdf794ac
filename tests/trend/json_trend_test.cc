#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "golden.h"
#include "json_keys.h"
#include "lyrefit/report/json.h"
#include "lyrefit/trend/trend_documents.h"
#include "sample_trend.h"

namespace lyrefit {
namespace {

using nlohmann::json;

TEST(TrendJson, HoldsWhatTheReportHolds) {
  Golden golden("json_trend");
  golden.AddLong("a trend", Outline(json::parse(TrendJson(SampleTrend(90)))));
  golden.Check();
}

// [time, value, fitted, measurements]
TEST(TrendJson, HoldsTheDaysOfAQuantity) {
  const TrendReport report = SampleTrend(90);
  const json days = json::parse(TrendJson(report))["quantities"][1]["days"];
  ASSERT_EQ(days.size(), 90U);
  ASSERT_EQ(days[3].size(), 4U);
  EXPECT_EQ(days[3][0], "2025-03-15 10:00:00");
  EXPECT_NEAR(days[3][1].get<double>(), report.quantities[1].days[3].value, 1e-12);
  EXPECT_NEAR(days[3][2].get<double>(), report.quantities[1].days[3].fitted, 1e-12);
  EXPECT_EQ(days[3][3], 6);
}

TEST(TrendJson, TakesNamesThatAreNotUtf8) {
  TrendReport report = SampleTrend(12);
  report.name = "caf\xe9";
  report.reasons[0].reason = "\xff\xfe";
  EXPECT_TRUE(json::accept(TrendJson(report)));
}

}  // namespace
}  // namespace lyrefit
