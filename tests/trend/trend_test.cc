#include "lyrefit/trend/trend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "error_of.h"
#include "lyrefit/report/json.h"
#include "lyrefit/trend/trend_documents.h"
#include "repeats.h"
#include "trend/made_sweeps.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TrendReport ReportOf(const MadeYear& year, const TrendOptions& options = {}) {
  const TrendDevice device = MadeDevice();
  const auto report = FindTrend(ReducedBy(device, MakeSweeps(device, year)), options);
  EXPECT_TRUE(report) << MessageOf(report);
  return report.value_or(TrendReport());
}

const TrendQuantity& QuantityNamed(const TrendReport& report, const std::string& name) {
  const auto found = std::find_if(report.quantities.begin(), report.quantities.end(),
                                  [&](const TrendQuantity& one) { return one.name == name; });
  EXPECT_NE(found, report.quantities.end()) << name;
  return *found;
}

Ranged EnergyLost(const TrendReport& report, const std::string& part) {
  for (const TrendLoss& loss : report.losses) {
    if (loss.name == part) return loss.energy_percent;
  }
  ADD_FAILURE() << part;
  return {};
}

bool Holds(const Ranged& range, double value) {
  return range.low_95 <= value && value <= range.high_95;
}

double DayOf(double time_s) { return (time_s - kMadeStart_s) / kDay_s; }

MadeYear Days(int days) {
  MadeYear year;
  year.days = days;
  year.points = 24;
  return year;
}

TEST(FindTrend, WithoutAChangeHasNoOnsetAndNoLoss) {
  int held = 0, losses = 0, onsets = 0;
  const int draws = Repeats(10);
  for (int draw = 0; draw < draws; ++draw) {
    MadeYear year = Days(60);
    year.seed = 100 + static_cast<std::uint64_t>(draw);
    const TrendReport report = ReportOf(year);
    onsets += static_cast<int>(report.onsets.size());
    for (const TrendLoss& loss : report.losses) {
      ++losses;
      held += Holds(loss.energy_percent, 0) ? 1 : 0;
      EXPECT_NEAR(loss.energy_percent.value, 0, 0.5) << loss.name;
    }
  }
  EXPECT_GE(held, losses * 9 / 10);
  EXPECT_LE(onsets, 1);
}

TEST(FindTrend, DescribesTheSeries) {
  const TrendReport report = ReportOf(Days(60));
  EXPECT_EQ(report.name, "made");
  EXPECT_EQ(report.law, "the test");
  EXPECT_EQ(report.cells_in_series, 60);
  EXPECT_EQ(report.substrings, 3);
  EXPECT_EQ(report.rows, 360);
  EXPECT_EQ(report.days, 60U);
  std::int64_t all = 0;
  for (const std::int64_t count : report.states) all += count;
  EXPECT_EQ(all, 360);
  EXPECT_EQ(report.reasons.size(), 0U);
  EXPECT_NEAR(DayOf(report.first_s), 0.375, 1e-9);
  EXPECT_NEAR(DayOf(report.last_s), 59 + 16.0 / 24, 1e-9);
  const double made =
      MaximumPowerPoint(MadeDevice(), MadeState(MadeDevice(), 1000, 25), 25).power_W();
  EXPECT_NEAR(report.reference_power_W, made, 0.01 * made);
  EXPECT_NEAR(QuantityNamed(report, "resistance_series").reference, 0.3, 0.01);
  EXPECT_NEAR(QuantityNamed(report, "conductance_shunt").reference, 1 / 400.0, 2e-4);
  EXPECT_NEAR(QuantityNamed(report, "p_mp").reference, 100, 0.5);
  EXPECT_FALSE(report.interrupted);
  EXPECT_NE(report.verdict, "");
}

TEST(FindTrend, PartsOfALossAddUp) {
  MadeYear year = Days(60);
  year.change = [](int day) {
    MadeChange now;
    now.light = 1 - 0.001 * day;
    now.series = 1 + 0.01 * day;
    return now;
  };
  const TrendReport report = ReportOf(year);
  double energy = 0, recent = 0;
  for (std::size_t p = 0; p + 1 < report.losses.size(); ++p) {
    energy += report.losses[p].energy_percent.value;
    recent += report.losses[p].now_percent.value;
  }
  EXPECT_EQ(report.losses.back().name, "total");
  EXPECT_NEAR(report.losses.back().energy_percent.value, energy, 1e-9);
  EXPECT_NEAR(report.losses.back().now_percent.value, recent, 1e-9);
}

TEST(FindTrend, FindsAStepOfTheSeriesResistance) {
  MadeYear year = Days(90);
  year.change = [](int day) {
    MadeChange now;
    now.series = day >= 55 ? 1.5 : 1;
    return now;
  };
  const TrendReport report = ReportOf(year);
  const TrendQuantity& series = QuantityNamed(report, "resistance_series");
  ASSERT_EQ(series.changes.size(), 1U);
  const TrendChange& change = series.changes.front();
  EXPECT_FALSE(change.onset);
  EXPECT_NEAR(DayOf(change.time_s), 55.5, 1);
  EXPECT_LE(change.earliest_s, change.time_s);
  EXPECT_GE(change.latest_s, change.time_s);
  EXPECT_NEAR(change.size.value, 0.15, 0.01);
  EXPECT_TRUE(Holds(change.size, 0.15));
  ASSERT_EQ(report.onsets.size(), 1U);
  EXPECT_EQ(report.onsets[0].quantity, "resistance_series");
  EXPECT_EQ(report.onsets[0].cause.title, "a step of the series resistance");
  EXPECT_GT(report.onsets[0].lost_percent, 1);
  const Ranged lost = EnergyLost(report, "resistance_series");
  EXPECT_GT(lost.value, 0.3);
  EXPECT_NEAR(lost.value, EnergyLost(report, "total").value, 0.3);
  EXPECT_THAT(report.verdict, HasSubstr("a step of the series resistance"));
}

TEST(FindTrend, FindsTheRateOfAGrowingSeriesResistance) {
  MadeYear year = Days(120);
  year.change = [](int day) {
    MadeChange now;
    now.series = 1 + 0.6 * day / 365.25;
    return now;
  };
  const TrendReport report = ReportOf(year);
  const TrendQuantity& series = QuantityNamed(report, "resistance_series");
  const double years = year.days / 365.25;
  EXPECT_NEAR(series.change.value, 0.18 * years, 0.02 * years);
  EXPECT_TRUE(Holds(series.change, 0.18 * years));
  EXPECT_GT(EnergyLost(report, "resistance_series").low_95, 0);
  EXPECT_TRUE(Holds(EnergyLost(report, "shunt"), 0));
}

TEST(FindTrend, FindsLightThatFalls) {
  MadeYear year = Days(90);
  year.change = [](int day) {
    MadeChange now;
    now.light = day < 45 ? 1 : 1 - 0.002 * (day - 45);
    return now;
  };
  const TrendReport report = ReportOf(year);
  const Ranged light = EnergyLost(report, "light");
  EXPECT_GT(light.low_95, 0);
  EXPECT_NEAR(light.value, EnergyLost(report, "total").value, 0.3);
  EXPECT_LT(QuantityNamed(report, "light").change.high_95, 0);
  EXPECT_THAT(report.verdict, HasSubstr("by light"));
  EXPECT_TRUE(std::any_of(
      report.not_decided.begin(), report.not_decided.end(),
      [](const std::string& one) { return one.find("light sensor") != std::string::npos; }));
}

TEST(FindTrend, FindsAShuntAndRecombinationThatGrowTogether) {
  MadeYear year = Days(120);
  year.change = [](int day) {
    MadeChange now;
    const double since = std::max(day - 60, 0);
    now.shunt = 1 + since / 8;
    now.recombination = 1 + since / 30;
    return now;
  };
  const TrendReport report = ReportOf(year);
  ASSERT_FALSE(report.onsets.empty());
  for (const TrendOnset& onset : report.onsets) {
    EXPECT_EQ(onset.cause.title, "potential-induced degradation");
    EXPECT_GT(DayOf(onset.latest_s), 55);
  }
  EXPECT_NEAR(DayOf(report.onsets.front().time_s), 60, 10);
  EXPECT_GT(EnergyLost(report, "shunt").low_95, 0);
  EXPECT_GT(EnergyLost(report, "recombination").low_95, 0);
}

TEST(FindTrend, FindsASubstringThatIsLost) {
  MadeYear year = Days(90);
  year.change = [](int day) {
    MadeChange now;
    now.lost_substrings = day >= 50 ? 1 : 0;
    return now;
  };
  const TrendReport report = ReportOf(year);
  ASSERT_EQ(report.onsets.size(), 1U);
  EXPECT_EQ(report.onsets[0].cause.title, "1 of 3 substrings without voltage");
  EXPECT_NEAR(DayOf(report.onsets[0].time_s), 50.5, 1);
  EXPECT_NEAR(DayOf(report.onsets[0].earliest_s), 49.5, 1);
  EXPECT_NEAR(report.onsets[0].lost_percent, 100 / 3.0, 1.5);
  EXPECT_NEAR(EnergyLost(report, "mismatch").value, EnergyLost(report, "total").value, 0.5);
}

TEST(FindTrend, BelowAYearHasAChangeAndNoRate) {
  const TrendReport report = ReportOf(Days(120));
  for (const TrendQuantity& quantity : report.quantities) {
    EXPECT_TRUE(std::isnan(quantity.rate_per_year.value)) << quantity.name;
    EXPECT_TRUE(std::isnan(quantity.rate_percent.value)) << quantity.name;
    EXPECT_TRUE(std::isfinite(quantity.change.value)) << quantity.name;
  }
  EXPECT_THAT(TrendText(report), AllOf(HasSubstr("has no rates"), Not(HasSubstr("a year  "))));
}

TEST(FindTrend, ClaimsNoOnsetOfWhatTakesNoPower) {
  MadeYear year = Days(90);
  year.change = [](int day) {
    MadeChange now;
    now.series = day >= 55 ? 1.03 : 1;  // 0.009 ohm, 0.2 % of the power
    return now;
  };
  EXPECT_TRUE(ReportOf(year).onsets.empty());
  TrendOptions all;
  all.least_onset_percent = 0;
  const TrendReport report = ReportOf(year, all);
  ASSERT_EQ(report.onsets.size(), 1U);
  EXPECT_EQ(report.onsets[0].cause.id, "series_resistance_step");
}

// A sensor that shows more light than the device gets the duller the sky is, from one long dull
// spell to the next.
MadeYear UnderDullSkies(int days) {
  MadeYear year = Days(days);
  year.clearness = [](int day, RandomStream* random) {
    const bool dull = day % 40 < 25;
    return dull ? 0.3 + 0.3 * random->Uniform() : 0.95 + 0.05 * random->Uniform();
  };
  year.dull_sensor = 0.2;
  return year;
}

TEST(FindTrend, CallsADullSkyNoLoss) {
  for (const std::uint64_t seed : {11, 12}) {
    MadeYear year = UnderDullSkies(150);
    year.seed = seed;
    const TrendReport report = ReportOf(year);
    EXPECT_NEAR(EnergyLost(report, "light").value, 0, 1);
    EXPECT_TRUE(Holds(EnergyLost(report, "total"), 0));
    EXPECT_GT(report.dull_sky_percent, 2);
    EXPECT_THAT(report.verdict, HasSubstr("under dull skies"));
  }
}

TEST(FindTrend, FindsDirtUnderDullSkies) {
  MadeYear year = UnderDullSkies(150);
  year.change = [](int day) {
    MadeChange now;
    now.light = day < 75 ? 1 : 0.92;
    return now;
  };
  const TrendReport report = ReportOf(year);
  EXPECT_NEAR(EnergyLost(report, "light").value, 4, 1.2);
  EXPECT_GT(EnergyLost(report, "light").low_95, 0);
}

TEST(FindTrend, NamesTheDaysOnWhichTheDeviceWasCovered) {
  MadeYear year = Days(90);
  year.change = [](int day) {
    MadeChange now;
    now.light = day == 50 || day == 51 || day == 60 ? 0.6 : 1;
    return now;
  };
  const TrendReport report = ReportOf(year);
  ASSERT_EQ(report.covered.size(), 1U);
  EXPECT_FALSE(report.covered[0].frost);
  ASSERT_EQ(report.covered[0].days_s.size(), 3U);
  EXPECT_NEAR(DayOf(report.covered[0].days_s[0]), 50.5, 0.5);
  EXPECT_NEAR(report.covered[0].lost_percent, 1.3, 0.6);
  EXPECT_THAT(report.verdict, HasSubstr("2025-05-01 to 2025-05-02, 2025-05-11"));
  EXPECT_TRUE(report.onsets.empty());
}

TEST(FindTrend, EndsWhereAnotherDeviceBegins) {
  MadeYear year = Days(120);
  year.change = [](int day) {
    MadeChange now;
    if (day < 70) return now;
    now.light = 1.05;
    now.series = 0.8;
    now.recombination = 0.4;
    now.shunt = 0.5;
    return now;
  };
  const TrendReport report = ReportOf(year);
  EXPECT_NEAR(DayOf(report.last_s), 69.7, 1.1);
  EXPECT_TRUE(report.onsets.empty());
  EXPECT_TRUE(Holds(EnergyLost(report, "total"), 0));
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_THAT(report.warnings.back(),
              AllOf(HasSubstr("of another device"), HasSubstr("2025-05-2")));
  EXPECT_THAT(report.verdict, HasSubstr("of another device"));
}

TEST(FindTrend, WarnsOfADayOnWhichAllGetsWorse) {
  MadeYear year = Days(120);
  year.change = [](int day) {
    MadeChange now;
    if (day < 70) return now;
    now.light = 0.95;
    now.series = 1.25;
    now.recombination = 1.25;
    return now;
  };
  const TrendReport report = ReportOf(year);
  EXPECT_NEAR(DayOf(report.last_s), 119.7, 1.1);
  EXPECT_FALSE(report.onsets.empty());
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_THAT(report.warnings.back(),
              AllOf(HasSubstr("On 2025-05-2"), HasSubstr("another device")));
}

TEST(FindTrend, CallsLightThatStaysAwayNoSnow) {
  MadeYear year = Days(150);
  year.change = [](int day) {
    MadeChange now;
    now.light = day < 70 ? 1 : 0.7;
    return now;
  };
  const TrendReport report = ReportOf(year);
  EXPECT_TRUE(report.covered.empty());
  EXPECT_NEAR(EnergyLost(report, "light").value, 100 * 0.3 * 80 / 150, 1.5);
  EXPECT_THAT(report.verdict, Not(HasSubstr("Covered")));
}

TEST(FindTrend, DoubtsALawOfNoJunction) {
  TrendDevice device = MadeDevice();
  const std::vector<TimedSweep> sweeps = MakeSweeps(device, Days(45));
  const auto right = FindTrend(ReducedBy(device, sweeps));
  ASSERT_TRUE(right);
  EXPECT_TRUE(right->warnings.empty());
  device.n = 0.5;
  const auto wrong = FindTrend(ReducedBy(device, sweeps));
  ASSERT_TRUE(wrong) << MessageOf(wrong);
  ASSERT_FALSE(wrong->warnings.empty());
  EXPECT_THAT(wrong->warnings[0], HasSubstr("n = 0.50, of no junction"));
}

TEST(FindTrend, CountsARowWithoutATimeAndNoMoreOfIt) {
  const TrendDevice device = MadeDevice();
  TrendSeries series = ReducedBy(device, MakeSweeps(device, Days(45)));
  const auto without = FindTrend(series);
  ASSERT_TRUE(without);
  TrendRow untimed;
  untimed.reason = "no date";
  for (const std::size_t place : {std::size_t{9}, std::size_t{100}, series.rows.size()}) {
    series.rows.insert(series.rows.begin() + static_cast<std::ptrdiff_t>(place), untimed);
  }
  const auto with = FindTrend(series);
  ASSERT_TRUE(with);
  EXPECT_EQ(with->rows, without->rows + 3);
  EXPECT_EQ(with->states[static_cast<int>(TrendRowState::kUnusable)], 3);
  ASSERT_EQ(with->reasons.size(), 1U);
  EXPECT_EQ(with->reasons[0].rows, 3);
  EXPECT_EQ(with->days, without->days);
  EXPECT_EQ(with->verdict, without->verdict);
  EXPECT_EQ(EnergyLost(*with, "total").value, EnergyLost(*without, "total").value);
}

// What readings of units and columns that were mistaken look like.
struct Mistake {
  const char* name;
  void (*make)(IvCurve* curve);
  const char* said;
};

TEST(FindTrend, LeavesOutWhatNoDeviceGivesAndSaysWhen) {
  const Mistake mistakes[] = {
      {"mA",
       [](IvCurve* curve) {
         for (double& one : curve->current_A) one *= 1000;
       },
       "mA"},
      {"kW/m2", [](IvCurve* curve) { curve->conditions.irradiance_W_m2 /= 1000; }, "kW/m2"},
      {"columns", [](IvCurve* curve) { std::swap(curve->current_A, curve->voltage_V); },
       "exchanged"},
      {"cells", [](IvCurve* curve) { curve->conditions.cells_in_series = 72; },
       "a sweep of 72 cells in series, the law is of 60"},
      {"light", [](IvCurve* curve) { curve->conditions.irradiance_W_m2 = 1e300; },
       "an irradiance of 1e+300 W/m2"},
      {"strings",
       [](IvCurve* curve) {
         for (double& one : curve->current_A) one *= 2;
       },
       "2.0 times the current of the first sweeps in such light"}};
  const TrendDevice device = MadeDevice();
  for (const Mistake& mistake : mistakes) {
    std::vector<TimedSweep> sweeps = MakeSweeps(device, Days(90));
    for (TimedSweep& sweep : sweeps) {
      const double day = DayOf(sweep.time_s);
      if (day >= 50 && day < 60) mistake.make(&sweep.curve);
    }
    const auto report = FindTrend(ReducedBy(device, sweeps));
    ASSERT_TRUE(report) << mistake.name << ": " << MessageOf(report);
    EXPECT_EQ(report->states[static_cast<int>(TrendRowState::kDoubtful)], 60) << mistake.name;
    ASSERT_EQ(report->reasons.size(), 1U) << mistake.name;
    EXPECT_THAT(report->reasons[0].reason, HasSubstr(mistake.said));
    EXPECT_NEAR(DayOf(report->reasons[0].first_s), 50.375, 1e-6);
    EXPECT_TRUE(report->onsets.empty()) << mistake.name;
    EXPECT_TRUE(Holds(EnergyLost(*report, "total"), 0)) << mistake.name;
    EXPECT_THAT(report->verdict, HasSubstr("60 measurements that no device gives are left out"));
  }
}

TEST(FindTrend, CountsAMeasurementThatAFileRepeatsOnce) {
  const TrendDevice device = MadeDevice();
  TrendSeries series = ReducedBy(device, MakeSweeps(device, Days(45)));
  const auto once = FindTrend(series);
  for (int k = 0; k < 60; ++k) series.rows.push_back(series.rows[static_cast<std::size_t>(k)]);
  const auto twice = FindTrend(series);
  ASSERT_TRUE(once);
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->losses.back().energy_percent.value, once->losses.back().energy_percent.value);
  ASSERT_EQ(twice->reasons.size(), 1U);
  EXPECT_EQ(twice->reasons[0].rows, 60);
}

TEST(FindTrend, SameBitsOnAnyNumberOfThreads) {
  const TrendDevice device = MadeDevice();
  const std::vector<TimedSweep> sweeps = MakeSweeps(device, Days(45));
  TrendOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const auto alone = FindTrend(ReducedBy(device, sweeps, 1), one);
  const auto shared = FindTrend(ReducedBy(device, sweeps, 2), two);
  ASSERT_TRUE(alone);
  ASSERT_TRUE(shared);
  EXPECT_EQ(TrendJson(*alone), TrendJson(*shared));
}

TEST(FindTrend, SameBitsInAnyOrderOfTheRows) {
  const TrendDevice device = MadeDevice();
  TrendSeries series = ReducedBy(device, MakeSweeps(device, Days(45)));
  const auto ordered = FindTrend(series);
  ASSERT_TRUE(ordered);
  std::reverse(series.rows.begin(), series.rows.end());
  const auto reversed = FindTrend(series);
  ASSERT_TRUE(reversed);
  EXPECT_EQ(TrendJson(*ordered), TrendJson(*reversed));
  RandomStream random(5);
  for (std::size_t i = series.rows.size(); i > 1; --i) {
    std::swap(series.rows[i - 1], series.rows[random.Index(static_cast<std::uint32_t>(i))]);
  }
  EXPECT_EQ(TrendJson(*ordered), TrendJson(*FindTrend(series)));
}

TEST(FindTrend, LeavesOutDimAndUnusableSweepsWithCounts) {
  const TrendDevice device = MadeDevice();
  TrendSeries series = ReducedBy(device, MakeSweeps(device, Days(45)));
  std::vector<TimedSweep> dim = {
      {MadeSweep(device, MadeState(device, 60, 10), 60, 10), kMadeStart_s + 3600 * 7}};
  AppendSweeps(dim, 1, &series);
  dim[0].curve.irradiance_known = false;
  AppendSweeps(dim, 1, &series);
  AppendSweeps(dim, 1, &series);
  const auto report = FindTrend(series);
  ASSERT_TRUE(report) << MessageOf(report);
  EXPECT_EQ(report->states[static_cast<int>(TrendRowState::kDim)], 1);
  EXPECT_EQ(report->states[static_cast<int>(TrendRowState::kUnusable)], 2);
  ASSERT_EQ(report->reasons.size(), 1U);
  EXPECT_EQ(report->reasons[0].reason, "no irradiance");
  EXPECT_EQ(report->reasons[0].rows, 2);
}

TEST(FindTrend, OfOneDayIsCutIntoShorterBlocks) {
  MadeYear year = Days(1);
  year.per_day = 200;
  const TrendReport report = ReportOf(year);
  EXPECT_GT(report.days, 20U);
  EXPECT_TRUE(std::isnan(QuantityNamed(report, "resistance_series").rate_per_year.value));
}

TEST(FindTrend, RefusesASeriesThatIsTooShort) {
  const TrendDevice device = MadeDevice();
  MadeYear year = Days(1);
  year.per_day = 3;
  for (const TrendSeries& series :
       {ReducedBy(device, {}), ReducedBy(device, MakeSweeps(device, year))}) {
    EXPECT_THAT(MessageOf(FindTrend(series)),
                AllOf(HasSubstr("expected usable measurements at 5 times or more, found"),
                      HasSubstr("lyrefit fit FILES --csv")));
  }
  TrendSeries unusable = ReducedBy(device, {});
  for (int k = 0; k < 50; ++k) {
    AppendOperatingPoint(kMadeStart_s + k * kDay_s, kUnknown, 40, 30, 8, &unusable);
  }
  EXPECT_THAT(MessageOf(FindTrend(unusable)), HasSubstr("0 of 50 measurements count"));
}

TEST(FindTrend, StopsWhenItsObserverAsksForIt) {
  const TrendDevice device = MadeDevice();
  const TrendSeries series = ReducedBy(device, MakeSweeps(device, Days(30)));
  int calls = 0;
  const auto stop = [&](const Progress&) {
    ++calls;
    return ObserverAction::kStop;
  };
  EXPECT_EQ(MessageOf(FindTrend(series, TrendOptions(), stop)), "interrupted");
  EXPECT_EQ(calls, 1);
}

TEST(FindTrend, RefusesOptionsOutsideTheirRanges) {
  TrendOptions options;
  options.false_alarms_per_year = 0;
  EXPECT_FALSE(FindTrend(ReducedBy(MadeDevice(), {}), options));
}

}  // namespace
}  // namespace lyrefit
