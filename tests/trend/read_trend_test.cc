#include "lyrefit/trend/read_trend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "error_of.h"
#include "lyrefit/read/read_pvlib.h"
#include "lyrefit/trend/trend.h"
#include "temp_folder.h"
#include "trend/sweeps_text.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<TimedSweep> TenDays() {
  MadeYear year;
  year.days = 10;
  year.per_day = 4;
  return MakeSweeps(MadeDevice(), year);
}

Expected<TrendSeries> ReadFile(const std::string& path, const TrendReadOptions& reading = {}) {
  return ReadTrend({path}, reading, TrendOptions());
}

// What the rows of two series have in common with each other, to the last bit.
void ExpectSameRows(const TrendSeries& one, const TrendSeries& other) {
  ASSERT_EQ(one.rows.size(), other.rows.size());
  EXPECT_EQ(one.device->saturation_current_A, other.device->saturation_current_A);
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].time_s, other.rows[i].time_s);
    EXPECT_EQ(one.rows[i].parameters, other.rows[i].parameters);
  }
}

TrendSeries Sorted(TrendSeries series) {
  std::sort(series.rows.begin(), series.rows.end(),
            [](const TrendRow& a, const TrendRow& b) { return a.time_s < b.time_s; });
  return series;
}

TEST(ReadTrend, TakesDatesBesideTheSweeps) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  const std::string text = SweepsText(sweeps);
  for (const std::string name : {"date", "timestamp", "time", "datetime", "tmst"}) {
    const std::string path = folder.Write("module7.csv", name + text.substr(4));
    const auto series = ReadFile(path);
    ASSERT_TRUE(series) << name << ": " << series.error().ToString();
    ASSERT_EQ(series->rows.size(), sweeps.size()) << name;
    EXPECT_EQ(series->name, "module7");
    EXPECT_EQ(series->source, TrendSource::kSweeps);
    EXPECT_EQ(series->device->cells_in_series, 60);
    EXPECT_EQ(series->device->substrings, 3);
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      EXPECT_NEAR(series->rows[i].time_s, sweeps[i].time_s, 0.6);
      EXPECT_EQ(series->rows[i].state, TrendRowState::kUsed);
      EXPECT_NEAR(series->rows[i].parameters[kTrendSeries], 0.3, 0.05);
    }
  }
}

TEST(ReadTrend, TakesDatesInTheNamesOfFiles) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  const std::pair<const char*, const char*> names[] = {
      {"module7_20250312_1030.csv", "2025-03-12 10:30:00"},
      {"module7_20250312_113005.csv", "2025-03-12 11:30:05"},
      {"2025-03-13T10-30.csv", "2025-03-13 10:30:00"},
      {"2025-03-14.csv", "2025-03-14 00:00:00"},
      {"m12345678901_2025-03-15 09.30.csv", "2025-03-15 09:30:00"},
      {"day 2025_03_16 10_30 roof.csv", "2025-03-16 10:30:00"}};
  std::size_t k = 0;
  for (const auto& [name, time] : names) {
    const IvCurve& curve = sweeps[4 * k++ + 1].curve;
    std::string text = fmt::format("# irradiance: {} W/m2\n# cell temperature: {} C\n# cells: 60\n",
                                   curve.conditions.irradiance_W_m2,
                                   curve.conditions.cell_temperature_K - kZeroCelsius_K);
    text += "voltage_V,current_A\n";
    for (std::size_t i = 0; i < curve.size(); ++i) {
      text += fmt::format("{},{}\n", curve.voltage_V[i], curve.current_A[i]);
    }
    folder.Write(std::string("roof/") + name, text);
  }
  const auto series = ReadFile(folder.Path("roof"));
  ASSERT_TRUE(series) << series.error().ToString();
  std::vector<std::string> times, expected;
  for (const TrendRow& row : series->rows) times.push_back(DateTimeText(row.time_s));
  for (const auto& [name, time] : names) expected.emplace_back(time);
  EXPECT_THAT(times, ::testing::UnorderedElementsAreArray(expected));
  EXPECT_EQ(series->name, "roof");
}

TEST(ReadTrend, TakesTheDatesOfASet) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  std::string curves = "curve,voltage_V,current_A\n";
  std::string index = "curve,timestamp,irradiance_W_m2,temperature_C\n";
  for (std::size_t k = 0; k < 12; ++k) {
    const IvCurve& curve = sweeps[k].curve;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      curves += fmt::format("{},{},{}\n", k, curve.voltage_V[i], curve.current_A[i]);
    }
    index += fmt::format("{},{},{},{}\n", k, DateTimeText(sweeps[k].time_s),
                         curve.conditions.irradiance_W_m2,
                         curve.conditions.cell_temperature_K - kZeroCelsius_K);
  }
  folder.Write("roof/curves.csv", curves);
  folder.Write("roof/index.csv", index);
  folder.Write("roof/dataset.json", R"({"cells_in_series": 60, "bypass_diodes": 3})");
  const auto series = ReadFile(folder.Path("roof"));
  ASSERT_TRUE(series) << series.error().ToString();
  ASSERT_EQ(series->rows.size(), 12U);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_NEAR(series->rows[k].time_s, sweeps[k].time_s, 0.6);
    EXPECT_EQ(series->rows[k].state, TrendRowState::kUsed);
  }
}

TEST(ReadTrend, CountsASweepWithoutATimeWithItsPlace) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  const std::string text = SweepsText(sweeps);
  const std::size_t third = text.find('\n', text.find('\n') + 1) + 1;
  const std::size_t comma = text.find(',', third);
  for (const auto& [date, why] :
       {std::pair{"", "expected the time of the sweep"},
        {"03/04/2025", "expected a date such as 2025-03-12 10:30, found \"03/04/2025\""}}) {
    const auto series =
        ReadFile(folder.Write("a.csv", text.substr(0, third) + date + text.substr(comma)));
    ASSERT_TRUE(series) << series.error().ToString();
    ASSERT_EQ(series->rows.size(), sweeps.size());
    EXPECT_EQ(series->rows.back().state, TrendRowState::kUnusable);
    EXPECT_TRUE(std::isnan(series->rows.back().time_s));
    EXPECT_THAT(series->rows.back().reason, AllOf(HasSubstr("a.csv:3: "), HasSubstr(why)));
  }
}

TEST(ReadTrend, TellsDayFromMonthByAllDates) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  const std::string iso = SweepsText(sweeps);
  const auto expected = ReadFile(folder.Write("iso.csv", iso));
  ASSERT_TRUE(expected);
  // From 2025-03-06 on: days up to 12 come first.
  const auto with = [&](const char* date, int first_day) {
    std::string text = iso;
    for (int day = 0; day < 10; ++day) {
      const std::string from = DateText(kMadeStart_s + day * kDay_s);
      text = std::regex_replace(text, std::regex(from),
                                fmt::format(fmt::runtime(date), first_day + day));
    }
    return folder.Write("a.csv", text);
  };
  for (const char* date : {"{:02d}/03/2025", "03/{:02d}/2025"}) {
    const auto series = ReadFile(with(date, 6));
    ASSERT_TRUE(series) << MessageOf(series);
    ASSERT_EQ(series->rows.size(), expected->rows.size());
    for (std::size_t i = 0; i < series->rows.size(); ++i) {
      EXPECT_NEAR(series->rows[i].time_s, expected->rows[i].time_s - 6 * kDay_s, 0.6) << date;
    }
  }
  const auto either = ReadFile(with("{:02d}/03/2025", 1));
  ASSERT_FALSE(either);
  EXPECT_THAT(either.error().message, HasSubstr("found \"01/03/2025"));
  std::string both = iso;
  both.replace(both.find("2025-03-13"), 10, "13/03/2025")
      .replace(both.find("2025-03-14"), 10, "03/14/2025");
  const auto mixed = ReadFile(folder.Write("b.csv", both));
  ASSERT_FALSE(mixed);
  EXPECT_THAT(mixed.error().message, HasSubstr("in the other order"));
}

TEST(ReadTrend, RefusesSweepsOfWhichNoneHasATime) {
  const TempFolder folder;
  std::string text = SweepsText(TenDays());
  text.replace(0, 4, "when");
  const std::string path = folder.Write("a.csv", text);
  ExpectErrorAt(ReadFile(path), path + ":2", 0, 0, "expected the time of the sweep");
}

TEST(ReadTrend, CountsASweepOfAnotherDeviceWithTheReason) {
  const TempFolder folder;
  std::vector<TimedSweep> sweeps = TenDays();
  sweeps[7].curve.conditions.cells_in_series = 72;
  const auto series = ReadFile(folder.Write("a.csv", SweepsText(sweeps)));
  ASSERT_TRUE(series) << series.error().ToString();
  ASSERT_EQ(series->rows.size(), sweeps.size());
  EXPECT_EQ(series->rows[7].state, TrendRowState::kDoubtful);
  EXPECT_EQ(series->rows[7].reason, "a sweep of 72 cells in series, the law is of 60");
}

TEST(ReadTrend, RefusesAStateBesideSweeps) {
  const TempFolder folder;
  const std::string sweeps = folder.Write("a.csv", SweepsText(TenDays()));
  const std::string state = folder.Path("a.state");
  ASSERT_TRUE(AppendTrendState(state, *ReadFile(sweeps)));
  EXPECT_THAT(MessageOf(ReadTrend({state, sweeps}, {}, TrendOptions())),
              HasSubstr("the state of a trend is read alone"));
}

TEST(ReadTrend, RefusesSubstringsThatCannotBeEqual) {
  const TempFolder folder;
  std::vector<TimedSweep> sweeps = TenDays();
  for (TimedSweep& sweep : sweeps) sweep.curve.notes.bypass_diodes = 7;
  EXPECT_THAT(MessageOf(ReadFile(folder.Write("a.csv", SweepsText(sweeps)))),
              HasSubstr("60 cells have no 7 equal substrings"));
}

TEST(ReadTrend, CountsSweepsThatCannotBeReadWithTheReason) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  std::string text = SweepsText(sweeps);
  text += "2025-03-30 10:00,800,40,60,3,0 1 2 x,1 1 1 1\n";
  text += "2025-03-30 11:00,800,40,60,3,NaN 1 2,1 1 1\n";
  text += "2025-03-30 12:00,800,40,60,3,30,8\n";  // one point
  text += "2025-03-30 13:00,,40,60,3,0 10 20 25 30 32 34 35 36,8 8 8 8 7.5 7 5 3 0\n";
  const auto series = ReadFile(folder.Write("a.csv", text));
  ASSERT_TRUE(series) << series.error().ToString();
  ASSERT_EQ(series->rows.size(), sweeps.size() + 4);
  int unusable = 0;
  for (const TrendRow& row : series->rows) {
    if (row.state != TrendRowState::kUnusable) continue;
    ++unusable;
    EXPECT_NE(row.reason, "");
    EXPECT_EQ(DateText(row.time_s), "2025-03-30");
  }
  EXPECT_EQ(unusable, 4);
}

TEST(ReadTrend, KeepsTheSweepsReadBeforeAStop) {
  const TempFolder folder;
  MadeYear year;
  year.days = 30;
  year.per_day = 4;
  year.points = 20;
  const std::string path = folder.Write("a.csv", SweepsText(MakeSweeps(MadeDevice(), year)));
  const Observer stop = [](const Progress& progress) {
    return progress.iteration >= 60 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  const auto series = ReadTrend({path}, {}, TrendOptions(), stop);
  ASSERT_TRUE(series) << series.error().ToString();
  EXPECT_TRUE(series->interrupted);
  EXPECT_EQ(series->rows.size(), 60U);
  const auto report = FindTrend(*series, TrendOptions(), stop);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_TRUE(report->interrupted);
  EXPECT_EQ(report->rows, 60);
  ASSERT_FALSE(report->warnings.empty());
  EXPECT_THAT(report->warnings.front(), HasSubstr("of the first 60 measurements"));
}

TEST(ReadTrend, OrderOfTheSweepsDoesNotMatter) {
  const TempFolder folder;
  MadeYear year;
  year.days = 80;
  year.per_day = 4;
  year.points = 20;
  std::vector<TimedSweep> sweeps = MakeSweeps(MadeDevice(), year);
  const auto ordered = ReadFile(folder.Write("a.csv", SweepsText(sweeps)));
  ASSERT_TRUE(ordered) << ordered.error().ToString();
  std::reverse(sweeps.begin(), sweeps.end());
  const auto reversed = ReadFile(folder.Write("b.csv", SweepsText(sweeps)));
  ASSERT_TRUE(reversed) << reversed.error().ToString();
  ExpectSameRows(*ordered, Sorted(*reversed));
  RandomStream random(5);
  for (std::size_t i = sweeps.size(); i > 1; --i) {
    std::swap(sweeps[i - 1], sweeps[random.Index(static_cast<std::uint32_t>(i))]);
  }
  const auto shuffled = ReadFile(folder.Write("c.csv", SweepsText(sweeps)));
  ASSERT_TRUE(shuffled) << shuffled.error().ToString();
  ExpectSameRows(*ordered, Sorted(*shuffled));
}

TEST(ReadTrend, DirectionOfASweepDoesNotMatter) {
  const TempFolder folder;
  std::vector<TimedSweep> sweeps = TenDays();
  const auto up = ReadFile(folder.Write("a.csv", SweepsText(sweeps)));
  for (TimedSweep& sweep : sweeps) {
    std::reverse(sweep.curve.voltage_V.begin(), sweep.curve.voltage_V.end());
    std::reverse(sweep.curve.current_A.begin(), sweep.curve.current_A.end());
  }
  const auto down = ReadFile(folder.Write("b.csv", SweepsText(sweeps)));
  ASSERT_TRUE(up);
  ASSERT_TRUE(down) << down.error().ToString();
  ASSERT_EQ(up->rows.size(), down->rows.size());
  for (std::size_t i = 0; i < up->rows.size(); ++i) {
    EXPECT_NEAR(up->rows[i].parameters[kTrendSeries], down->rows[i].parameters[kTrendSeries], 1e-4);
  }
}

TEST(ReadTrend, KeepsDuplicatedSweeps) {
  const TempFolder folder;
  std::vector<TimedSweep> sweeps = TenDays();
  const std::size_t count = sweeps.size();
  sweeps.push_back(sweeps.front());
  const auto series = ReadFile(folder.Write("a.csv", SweepsText(sweeps)));
  ASSERT_TRUE(series) << series.error().ToString();
  EXPECT_EQ(series->rows.size(), count + 1);
}

TEST(ReadTrend, FilesFollowEachOther) {
  const TempFolder folder;
  const std::vector<TimedSweep> sweeps = TenDays();
  const std::vector<TimedSweep> first(sweeps.begin(), sweeps.begin() + 20);
  const std::vector<TimedSweep> second(sweeps.begin() + 20, sweeps.end());
  const auto whole = ReadFile(folder.Write("whole.csv", SweepsText(sweeps)));
  const auto parts = ReadTrend({folder.Write("first.csv", SweepsText(first)),
                                folder.Write("second.csv", SweepsText(second))},
                               {}, TrendOptions());
  ASSERT_TRUE(whole);
  ASSERT_TRUE(parts) << parts.error().ToString();
  ExpectSameRows(*whole, *parts);
  EXPECT_EQ(parts->name, "first");
}

TEST(ReadTrend, UsesTheLawOfAModule) {
  const TempFolder folder;
  const auto module = ReadPvlibParameters(folder.Write(
      "module.json", R"({"alpha_sc": 0.0045, "a_ref": 1.55, "I_L_ref": 9.1, "I_o_ref": 1.2e-10,
                         "R_s": 0.31, "R_sh_ref": 400, "cells_in_series": 60})"));
  ASSERT_TRUE(module) << module.error().ToString();
  TrendReadOptions reading;
  const auto law = SeriesOfModule(*module, TrendSource::kSweeps, 0);
  ASSERT_TRUE(law);
  reading.law = *law;
  const auto series = ReadFile(folder.Write("a.csv", SweepsText(TenDays())), reading);
  ASSERT_TRUE(series) << series.error().ToString();
  EXPECT_EQ(series->law, "module.json");
  EXPECT_EQ(series->device->photocurrent_A, 9.1);
}

TEST(ReadTrend, PreparesEachSweep) {
  const TempFolder folder;
  TrendReadOptions reading;
  reading.prepare = [](IvCurve* curve) -> Expected<void> {
    curve->conditions.irradiance_W_m2 *= 2;
    return {};
  };
  const std::vector<TimedSweep> sweeps = TenDays();
  const std::string path = folder.Write("a.csv", SweepsText(sweeps));
  const auto series = ReadFile(path, reading);
  ASSERT_TRUE(series);
  EXPECT_NEAR(series->rows[0].irradiance_W_m2, 2 * sweeps[0].curve.conditions.irradiance_W_m2,
              0.02);
  reading.prepare = [](IvCurve*) -> Expected<void> { return Fail("not this one"); };
  EXPECT_EQ(MessageOf(ReadFile(path, reading)), "not this one");
}

TEST(ReadTrend, RefusesWhatHoldsNoSweep) {
  const TempFolder folder;
  EXPECT_EQ(MessageOf(ReadTrend({}, {}, TrendOptions())), "expected sweeps, found no file");
  EXPECT_FALSE(ReadFile(folder.Write("empty.csv", "")));
  EXPECT_FALSE(ReadFile(folder.Write("head.csv", kSweepsHead)));
  EXPECT_FALSE(ReadFile(folder.Path("missing.csv")));
  const auto dark = ReadFile(folder.Write(
      "dark.csv", std::string(kSweepsHead) + "2025-03-12,0,20,60,3,0 10 20 30,0 0 0 0\n"));
  EXPECT_THAT(MessageOf(dark), AllOf(StartsWith("expected sweeps from 0 V to open circuit"),
                                     HasSubstr("5 times or more, found 1")));
}

TEST(ReadOperatingPoints, NeedsTheLawOfAModule) {
  const TempFolder folder;
  const std::string path = folder.Write("points.csv",
                                        "time,irradiance,temperature,vmp,imp\n"
                                        "2025-03-12 10:30,800,41,30,7\n"
                                        "2025-03-12 10:40,800,,30,7\n"
                                        "2025-03-12 20:40,0,20,0,0\n");
  EXPECT_THAT(MessageOf(ReadOperatingPoints({path}, {})), HasSubstr("name it (--module)"));
  TrendReadOptions reading;
  reading.law = ReducedBy(MadeDevice(), {});
  reading.law->name = "";
  const auto series = ReadOperatingPoints({path}, reading);
  ASSERT_TRUE(series) << series.error().ToString();
  EXPECT_EQ(series->name, "points");
  ASSERT_EQ(series->rows.size(), 3U);
  EXPECT_EQ(series->rows[0].state, TrendRowState::kUsed);
  EXPECT_EQ(series->rows[0].power_W(), 210);
  EXPECT_EQ(series->rows[1].reason, "a value is missing");
  EXPECT_EQ(series->rows[2].reason, "dark");
  EXPECT_THAT(MessageOf(ReadOperatingPoints({}, reading)), HasSubstr("found no file"));
}

}  // namespace
}  // namespace lyrefit
