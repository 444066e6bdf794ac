#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lyrefit/report/plots.h"
#include "lyrefit/trend/trend_documents.h"
#include "sample_trend.h"

namespace lyrefit {
namespace {

TEST(TrendFigure, HasTheLossesAndAPanelForEachQuantityWithDays) {
  const Figure figure = TrendFigure(SampleTrend(90));
  ASSERT_EQ(figure.panels.size(), 3U);  // no day tells the shunt
  EXPECT_EQ(figure.panels[0].series.size(), 5U);
  EXPECT_EQ(figure.legend.size(), 5U);
  EXPECT_EQ(figure.panels[2].title, "series resistance (ohm)");
  EXPECT_EQ(figure.panels[2].bands.size(), 2U);
}

TEST(TrendFigure, TicksAreDatesAndDoNotCrowd) {
  for (const int days : {4, 30, 90, 365, 3000}) {
    const Figure figure = TrendFigure(SampleTrend(days));
    for (const Panel& panel : figure.panels) {
      EXPECT_GE(panel.x.ticks.size(), 2U) << days;
      EXPECT_LE(panel.x.ticks.size(), 10U) << days;
      EXPECT_LE(panel.x.ticks.back().place, panel.x.high) << days;
    }
  }
}

TEST(TrendFigure, OfOneDayCountsDays) {
  TrendReport report = SampleTrend(1);
  report.last_s = report.first_s + 0.3 * kDay_s;
  const Figure figure = TrendFigure(report);
  EXPECT_THAT(figure.panels[0].x.label, ::testing::HasSubstr("2025-03-12 10:00:00"));
}

}  // namespace
}  // namespace lyrefit
