#include "lyrefit/trend/change_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "repeats.h"
#include "trend/drawn_series.h"

namespace lyrefit {
namespace {

constexpr double kChanged = 110.5;

ChangeOptions QuickChanges(double level) {
  ChangeOptions options;
  options.level = level;
  options.draws = 199;
  return options;
}

// A series that steps by `step` and then rises by `rate` a year from day 110.5 on.
TimeSeries Changed(const NoiseModel& noise, double step, double rate, std::uint64_t seed) {
  TimeSeries series = DrawErrors(noise, DaysWithGaps(240), seed);
  for (std::size_t i = 0; i < series.days.size(); ++i) {
    if (series.days[i] < kChanged) continue;
    series.values[i] += step + rate * (series.days[i] - kChanged) / 365.25;
  }
  return series;
}

// Number of series without a change in which one is found.
int FalseAlarms(const NoiseModel& noise, double level, int draws) {
  int alarms = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const TimeSeries series = DrawErrors(noise, DaysWithGaps(120), 1000 + draw);
    ChangeOptions options = QuickChanges(level);
    options.most = 1;
    options.seed = draw;
    alarms += FitChanges(series, LineDesign(series), options).changes.empty() ? 0 : 1;
  }
  return alarms;
}

// The level plus three standard deviations of a count.
double MostAlarms(double level, int draws) {
  return draws * level + 3 * std::sqrt(draws * level * (1 - level));
}

TEST(FitChanges, FindsAStepWithItsDayAndSize) {
  int held = 0;
  const int draws = Repeats(20);
  for (int draw = 0; draw < draws; ++draw) {
    const TimeSeries series = Changed({1, 0, 0}, 4, 0, draw);
    const ChangingSeries found = FitChanges(series, LineDesign(series), QuickChanges(0.005));
    ASSERT_EQ(found.changes.size(), 1U) << draw;
    const ChangePoint& change = found.changes.front();
    EXPECT_EQ(change.kind, ChangeKind::kStep) << draw;
    EXPECT_NEAR(change.day, kChanged, 3) << draw;
    EXPECT_LE(change.p_value, 0.005) << draw;
    held += change.day_low <= kChanged && change.day_high >= kChanged ? 1 : 0;
    const double error = std::sqrt(found.fit.covariance(change.column, change.column));
    EXPECT_NEAR(found.fit.coefficients[change.column], 4, 4 * error) << draw;
  }
  EXPECT_GE(held, draws * 8 / 10);
}

TEST(FitChanges, FindsAStepInTwentyYears) {
  TimeSeries series = DrawErrors({0.3, 0.3, 6}, DaysWithGaps(7300), 4);
  for (std::size_t i = 0; i < series.days.size(); ++i) {
    if (series.days[i] >= 5000.5) series.values[i] += 0.6;
  }
  const ChangingSeries found = FitChanges(series, LineDesign(series), {});
  ASSERT_EQ(found.changes.size(), 1U);
  EXPECT_EQ(found.changes[0].kind, ChangeKind::kStep);
  EXPECT_LE(found.changes[0].day_low, 5020);
  EXPECT_GE(found.changes[0].day_high, 4980);
  EXPECT_DOUBLE_EQ(found.changes[0].p_value, 0.001);
  const double size = found.fit.coefficients[found.changes[0].column];
  EXPECT_NEAR(size, 0.6, 4 * std::sqrt(found.fit.covariance(2, 2)));
}

TEST(FitChanges, FindsAnOnsetWithItsDayAndRate) {
  int held = 0, onsets = 0;
  const int draws = Repeats(20);
  for (int draw = 0; draw < draws; ++draw) {
    const TimeSeries series = Changed({1, 0, 0}, 0, 60, draw);
    const ChangingSeries found = FitChanges(series, LineDesign(series), QuickChanges(0.005));
    ASSERT_FALSE(found.changes.empty()) << draw;
    const ChangePoint& change = found.changes.front();
    if (change.kind != ChangeKind::kOnset) continue;
    ++onsets;
    EXPECT_NEAR(change.day, kChanged, 12) << draw;
    held += change.day_low <= kChanged && change.day_high >= kChanged ? 1 : 0;
    if (found.changes.size() == 1) {
      EXPECT_NEAR(found.fit.coefficients[change.column], 60, 10) << draw;
    }
  }
  EXPECT_GE(onsets, draws * 9 / 10);
  EXPECT_GE(held, onsets * 8 / 10);
}

TEST(FitChanges, RangeOfAChangeInAGapIsTheGap) {
  TimeSeries series = DrawErrors({1, 0, 0}, DaysWithGaps(240), 2);
  std::size_t first = 1;  // after the week without data in the middle
  while (series.days[first] - series.days[first - 1] < 8 || series.days[first] < 100) ++first;
  for (std::size_t i = first; i < series.values.size(); ++i) series.values[i] += 8;
  const ChangingSeries found = FitChanges(series, LineDesign(series), QuickChanges(0.005));
  ASSERT_EQ(found.changes.size(), 1U);
  EXPECT_EQ(found.changes[0].day, series.days[first]);
  EXPECT_EQ(found.changes[0].day_low, series.days[first - 1] + 1);
  EXPECT_EQ(found.changes[0].day_high, series.days[first]);
}

TEST(FitChanges, FindsAStepAmongErrorsThatDaysShare) {
  const TimeSeries series = Changed({0.5, 0.7, 5}, 6, 0, 3);
  const ChangingSeries found = FitChanges(series, LineDesign(series), QuickChanges(0.01));
  ASSERT_EQ(found.changes.size(), 1U);
  EXPECT_EQ(found.changes.front().kind, ChangeKind::kStep);
  EXPECT_NEAR(found.changes.front().day, kChanged, 2);
}

TEST(FitChanges, RaisesNoMoreFalseAlarmsThanTheLevel) {
  SKIP_IF_SANITIZED();  // a tenth of the draws says nothing of a rate of one in twenty
  const int draws = 300;
  const double level = 0.05;
  EXPECT_LE(FalseAlarms({1, 0, 0}, level, draws), MostAlarms(level, draws));
}

// The sizes of the errors are those of the fit that has the change, which takes over a part of what
// days share: the level is kept by independent errors only.
TEST(FitChanges, RaisesAtMostSixTimesTheLevelWhereDaysShareErrors) {
  SKIP_IF_SANITIZED();  // a tenth of the draws says nothing of a rate of one in twenty
  const int draws = 300;
  const double level = 0.05;
  EXPECT_LE(FalseAlarms({0.7, 0.7, 4}, level, draws), MostAlarms(6 * level, draws));
}

TEST(FitChanges, DoesNotDependOnTheUnit) {
  TimeSeries series = Changed({1, 0, 0}, 3, 0, 5);
  const ChangingSeries found = FitChanges(series, LineDesign(series), QuickChanges(0.01));
  ASSERT_FALSE(found.changes.empty());
  for (const double unit : {0x1p-30, 0x1p40}) {
    TimeSeries scaled = series;
    for (double& value : scaled.values) value *= unit;
    const ChangingSeries same = FitChanges(scaled, LineDesign(scaled), QuickChanges(0.01));
    ASSERT_EQ(same.changes.size(), found.changes.size()) << unit;
    for (std::size_t c = 0; c < found.changes.size(); ++c) {
      EXPECT_EQ(same.changes[c].kind, found.changes[c].kind);
      EXPECT_EQ(same.changes[c].day, found.changes[c].day);
      EXPECT_EQ(same.changes[c].p_value, found.changes[c].p_value);
      EXPECT_DOUBLE_EQ(same.fit.coefficients[same.changes[c].column],
                       unit * found.fit.coefficients[found.changes[c].column]);
    }
  }
}

TEST(FitChanges, KeepsTenDaysFromTheEndsAndFromOtherChanges) {
  TimeSeries series = DrawErrors({0.2, 0, 0}, DaysWithGaps(100), 1);
  for (std::size_t i = 4; i < series.values.size(); ++i) series.values[i] += 5;
  for (std::size_t i = 50; i < series.values.size(); ++i) series.values[i] += 5;
  for (std::size_t i = 55; i < series.values.size(); ++i) series.values[i] -= 5;
  const ChangingSeries found = FitChanges(series, LineDesign(series), QuickChanges(0.2));
  for (std::size_t c = 0; c < found.changes.size(); ++c) {
    EXPECT_GE(found.changes[c].day, series.days[10]);
    EXPECT_LE(found.changes[c].day, series.days[series.days.size() - 10]);
    for (std::size_t other = 0; other < c; ++other) {
      EXPECT_GE(std::fabs(found.changes[c].day - found.changes[other].day), 10);
    }
  }
}

TEST(FitChanges, LooksForNoneInAShortSeries) {
  TimeSeries series = DrawErrors({0.1, 0, 0}, DaysWithGaps(19), 1);
  for (std::size_t i = 8; i < series.values.size(); ++i) series.values[i] += 50;
  EXPECT_TRUE(FitChanges(series, LineDesign(series), QuickChanges(0.2)).changes.empty());
}

}  // namespace
}  // namespace lyrefit
