#include "lyrefit/trend/operating_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "trend/made_sweeps.h"

namespace lyrefit {
namespace {

TrendDevice OperatedDevice() {
  TrendDevice device = MadeDevice();
  device.saturation_current_2_A = 0;  // as a module file has
  return device;
}

// Operating points of 42 days, thirty a day, of a device with another series resistance that has
// lost a voltage.
std::vector<TrendRow> OperatingRows(double series_ohm, double lost_V, double noise) {
  const TrendDevice device = OperatedDevice();
  RandomStream random(36);
  TrendSeries series = ReducedBy(device, {});
  for (int day = 0; day < 42; ++day) {
    for (int k = 0; k < 30; ++k) {
      const double light = 0.15 + 0.85 * random.Uniform();
      const double temperature_C = 10 + 35 * light + 2 * random.Normal();
      const DeviceState state =
          StateOf(device, {0, series_ohm, -lost_V, 0, device.shunt_conductance_S},
                  device.Photocurrent(1000 * light, temperature_C), temperature_C);
      const TrendPoint point = MaximumPowerPoint(device, state, temperature_C);
      AppendOperatingPoint(kMadeStart_s + day * kDay_s + 3600 * (9 + 0.25 * k), 1000 * light,
                           temperature_C, point.voltage_V * (1 + noise * random.Normal()),
                           point.current_A * (1 + noise * random.Normal()), &series);
    }
  }
  return series.rows;
}

TEST(ReduceOperatingPoints, FindsSeriesResistanceAndVoltage) {
  std::vector<TrendRow> rows = OperatingRows(0.42, 1.2, 0);
  ReduceOperatingPoints(OperatedDevice(), TrendOptions(), &rows);
  int representing = 0;
  for (const TrendRow& row : rows) {
    if (row.state != TrendRowState::kUsed) continue;
    EXPECT_NEAR(row.parameters[kTrendSeries], 0.42, 1e-3);
    EXPECT_NEAR(row.parameters[kTrendVoltage], -1.2, 1e-2);
    EXPECT_NEAR(row.parameters[kTrendLight], 0, 1e-3);
    representing += row.represents ? 1 : 0;
  }
  EXPECT_GT(representing, 5 * 20);  // a day of each week
  EXPECT_LT(representing, 8 * 31);
}

TEST(ReduceOperatingPoints, NoiseOfAThousandthMovesItLittle) {
  std::vector<TrendRow> rows = OperatingRows(0.42, 0, 0.001);
  ReduceOperatingPoints(OperatedDevice(), TrendOptions(), &rows);
  double sum = 0, count = 0;
  for (const TrendRow& row : rows) {
    if (row.state != TrendRowState::kUsed || !row.represents) continue;
    sum += row.parameters[kTrendSeries];
    ++count;
  }
  EXPECT_NEAR(sum / count, 0.42, 0.02);
}

TEST(ReduceOperatingPoints, MarksRowsOffMaximumPower) {
  std::vector<TrendRow> rows = OperatingRows(0.3, 0, 0.001);
  for (std::size_t i = 5; i < rows.size(); i += 60) {
    rows[i].voltage_V *= 0.7;
    rows[i].current_A *= 1.03;
  }
  ReduceOperatingPoints(OperatedDevice(), TrendOptions(), &rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool off = i % 60 == 5;
    const bool dim = rows[i].irradiance_W_m2 < 200;
    if (off && !dim) {
      EXPECT_EQ(rows[i].state, TrendRowState::kOffMaximum) << i;
    } else {
      EXPECT_EQ(rows[i].state, dim ? TrendRowState::kDim : TrendRowState::kUsed) << i;
    }
  }
}

TEST(ReduceOperatingPoints, MarksRowsAtTheLimitOfTheInverter) {
  const TrendDevice device = OperatedDevice();
  std::vector<TrendRow> rows = OperatingRows(0.3, 0, 0);
  constexpr double kLimit_W = 200;
  int limited = 0;
  for (TrendRow& row : rows) {
    if (row.power_W() <= kLimit_W) continue;
    // The inverter raises the voltage until the power is the limit.
    const DeviceState state = MadeState(device, row.irradiance_W_m2, row.temperature_C);
    double low = row.voltage_V, high = 60;
    for (int step = 0; step < 60; ++step) {
      const double junction = 0.5 * (low + high);
      const double current = JunctionCurrent(device, state, junction, row.temperature_C);
      const double voltage = junction - 0.3 * current;
      (current > 0 && voltage * current > kLimit_W ? low : high) = junction;
      row.voltage_V = voltage;
      row.current_A = current;
    }
    ++limited;
  }
  ASSERT_GT(limited, 50);
  ReduceOperatingPoints(device, TrendOptions(), &rows);
  int marked = 0, wrong = 0;
  for (const TrendRow& row : rows) {
    if (row.state != TrendRowState::kLimited) continue;
    ++marked;
    wrong += row.power_W() < 0.99 * kLimit_W ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(marked, limited * 2 / 3);  // the others are as good as at maximum power
}

TEST(ReduceOperatingPoints, FindsSubstringsWithoutVoltage) {
  std::vector<TrendRow> rows = OperatingRows(0.3, 0, 0.001);
  TrendOptions options;
  options.reference_days = 14;
  const double lost_s = kMadeStart_s + 28 * kDay_s;
  for (TrendRow& row : rows) {
    if (row.time_s >= lost_s) row.voltage_V *= 2 / 3.0;
  }
  ReduceOperatingPoints(OperatedDevice(), options, &rows);
  for (const TrendRow& row : rows) {
    if (row.state != TrendRowState::kUsed) continue;
    EXPECT_EQ(row.lost_substrings, row.time_s >= lost_s ? 1 : 0);
    EXPECT_NEAR(row.parameters[kTrendSeries], 0.3, 0.05);
  }
}

TEST(ReduceOperatingPoints, OrderOfTheRowsDoesNotMatter) {
  std::vector<TrendRow> rows = OperatingRows(0.42, 0, 0.001);
  std::vector<TrendRow> reversed(rows.rbegin(), rows.rend());
  ReduceOperatingPoints(OperatedDevice(), TrendOptions(), &rows);
  ReduceOperatingPoints(OperatedDevice(), TrendOptions(), &reversed);
  ASSERT_EQ(rows.size(), reversed.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].time_s, reversed[i].time_s);
    if (rows[i].state == TrendRowState::kUsed) {
      EXPECT_EQ(rows[i].parameters, reversed[i].parameters);
    }
  }
}

TEST(ReduceOperatingPoints, LeavesRowsWithoutValuesAsTheyAre) {
  TrendSeries series = ReducedBy(OperatedDevice(), {});
  AppendOperatingPoint(kMadeStart_s, kUnknown, 40, 30, 8, &series);
  AppendOperatingPoint(kMadeStart_s + 60, 0, 10, 0, 0, &series);
  AppendOperatingPoint(kMadeStart_s + 120, 100, 10, 30, 1, &series);
  ReduceOperatingPoints(OperatedDevice(), TrendOptions(), &series.rows);
  EXPECT_EQ(series.rows[0].state, TrendRowState::kUnusable);
  EXPECT_EQ(series.rows[1].reason, "dark");
  EXPECT_EQ(series.rows[2].state, TrendRowState::kDim);
}

}  // namespace
}  // namespace lyrefit
