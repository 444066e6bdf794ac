#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/trend/trend_documents.h"
#include "sample_trend.h"

namespace lyrefit {
namespace {

using ::testing::StartsWith;

TEST(TrendCsv, HasARowADay) {
  const std::vector<std::string> lines = LinesOf(TrendCsv(SampleTrend(90)));
  ASSERT_EQ(lines.size(), 91U);
  EXPECT_EQ(lines[0],
            "time,p_mp_percent,resistance_series_ohm,conductance_shunt_S,loss_light_percent,"
            "loss_resistance_series_percent,loss_recombination_percent,loss_shunt_percent,"
            "loss_mismatch_percent");
  EXPECT_EQ(lines[1], "2025-03-12 10:00:00,100,0.3,,0.125,0.375,0.625,0.875,1.125");
  EXPECT_THAT(lines[90], StartsWith("2025-06-09 10:00:00,"));
}

TEST(TrendCsv, LeavesEmptyWhatADayDoesNotTell) {
  TrendReport report = SampleTrend(12);
  report.quantities[1].days.erase(report.quantities[1].days.begin());
  report.loss_days[4].erase(report.loss_days[4].begin());
  const std::vector<std::string> lines = LinesOf(TrendCsv(report));
  ASSERT_EQ(lines.size(), 13U);
  EXPECT_EQ(lines[1], "2025-03-12 10:00:00,100,,,0.125,0.375,0.625,0.875,");
}

}  // namespace
}  // namespace lyrefit
