#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

constexpr double kSampleStart_s = 20159 * kDay_s + 36000;  // 2025-03-12 10:00

// A quantity over `days` days that rises from `reference` by `rate` a year.
inline TrendQuantity SampleQuantity(const std::string& name, const std::string& title,
                                    const std::string& unit, double reference, double rate,
                                    int days) {
  TrendQuantity quantity;
  quantity.name = name;
  quantity.title = title;
  quantity.unit = unit;
  quantity.monitored = name == "resistance_series";
  quantity.reference = reference;
  const double apart = 0.2 * std::fabs(rate), percent = 100 / reference;
  quantity.rate_per_year = {rate, rate - apart, rate + apart};
  quantity.rate_percent = {percent * rate, percent * (rate - apart), percent * (rate + apart)};
  quantity.change = {0.25 * rate, 0.25 * (rate - apart), 0.25 * (rate + apart)};
  quantity.day_scatter = 0.01 * reference;
  quantity.shared_scatter = 0.02 * reference;
  quantity.half_life_days = 8;
  for (int day = 0; day < days; ++day) {
    const double fitted = reference + rate * day / 365.25;
    const double value = fitted + 0.01 * reference * std::sin(2.1 * day);
    quantity.days.push_back({kSampleStart_s + day * kDay_s, value, fitted, 6});
  }
  return quantity;
}

// A trend of `days` days with every section filled, written by hand.
inline TrendReport SampleTrend(int days) {
  TrendReport report;
  report.version = "1.2.3";
  report.name = "module 7";
  report.cells_in_series = 60;
  report.substrings = 3;
  report.ideality = 1.05;
  report.law = "60 sweeps of the reference days";
  report.first_s = kSampleStart_s;
  report.last_s = kSampleStart_s + (days - 1) * kDay_s;
  report.reference_end_s = kSampleStart_s + 30 * kDay_s;
  report.rows = 6 * days + 9;
  report.states = {6 * days, 1, 2, 0, 0, 6};
  report.reasons = {{"no irradiance", 5}, {"fewer than eight readings", 1}};
  report.days = static_cast<std::size_t>(days);
  report.reference_power_W = 274.5;
  report.options = {{"reference-days", "20", "30"}};
  report.quantities = {
      SampleQuantity("p_mp", "power, of what the reference lets expect", "%", 100, -4, days),
      SampleQuantity("resistance_series", "series resistance", "ohm", 0.3, 0.03, days)};
  TrendChange step;
  step.time_s = kSampleStart_s + 50 * kDay_s;
  step.earliest_s = step.time_s - kDay_s;
  step.latest_s = step.time_s + 2 * kDay_s;
  step.size = {0.1, 0.09, 0.11};
  step.p_value = 0.001;
  TrendChange onset = step;
  onset.onset = true;
  onset.time_s += 30 * kDay_s;
  onset.earliest_s = onset.time_s - 9 * kDay_s;
  onset.latest_s = onset.time_s + 9 * kDay_s;
  onset.size = {0.5, 0.3, 0.7};
  report.quantities[1].changes = {step, onset};
  report.quantities[1].seasonal = 0.012;
  TrendQuantity shunt;
  shunt.name = "conductance_shunt";
  shunt.title = "shunt conductance";
  shunt.unit = "S";
  shunt.missing = "too few days tell it";
  report.quantities.push_back(shunt);
  const char* const parts[] = {"light", "resistance_series", "recombination",
                               "shunt", "mismatch",          "total"};
  for (int p = 0; p < 6; ++p) {
    const double lost = p == 5 ? 3.125 : 0.125 + 0.25 * p;
    report.losses.push_back(
        {parts[p], {lost, lost - 0.25, lost + 0.25}, {2 * lost, lost, 3 * lost}});
    if (p == 5) break;
    report.loss_days.emplace_back();
    for (int day = 0; day < days; ++day) {
      report.loss_days.back().push_back(
          {kSampleStart_s + day * kDay_s, lost + 0.01 * day, kUnknown, 6});
    }
  }
  TrendOnset growing = {"resistance_series", step.time_s, step.earliest_s, step.latest_s, 0.6, {}};
  growing.cause.id = "step_series_resistance";
  growing.cause.title = "a step of the series resistance";
  growing.cause.sentence = "a connector, a clamp or an interconnect changed";
  growing.cause.action = "check connectors";
  report.onsets = {growing};
  report.verdict =
      "Since the reference the device gave 3.1 % (2.9 to 3.4) less energy than it "
      "would have given unchanged.";
  report.not_decided = {"shunt conductance: too few days tell it."};
  report.warnings = {"6 of 549 measurements are unusable."};
  report.seconds = 1.5;
  return report;
}

}  // namespace lyrefit
