// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/operating_rows.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lyrefit/base/median.h"
#include "lyrefit/curve/date_time.h"

namespace lyrefit {
namespace {

constexpr double kWeek_s = 7 * kDay_s;
constexpr std::size_t kLeastRows = 12;  // of a week

// What is found of a week: series resistance in ohm, voltage in V.
struct WeekParameters {
  double series = 0;
  double voltage = 0;
};

std::array<double, kTrendParameters> ParametersOf(const TrendDevice& device,
                                                  const WeekParameters& week, double light) {
  return {light, week.series, week.voltage, 0, device.shunt_conductance_S};
}

TrendPoint PointOf(const TrendDevice& device, const TrendRow& row, const WeekParameters& week,
                   double light) {
  const double expected_A = device.Photocurrent(row.irradiance_W_m2, row.temperature_C);
  return MaximumPowerPoint(
      device, StateOf(device, ParametersOf(device, week, light), expected_A, row.temperature_C),
      row.temperature_C);
}

double Left(const TrendDevice& device, const TrendRow& row) {
  return row.lost_substrings > 0 ? 1 - static_cast<double>(row.lost_substrings) / device.substrings
                                 : 1;
}

// ln of the voltage over that of the law.
double VoltageRatio(const TrendDevice& device, const TrendRow& row) {
  const WeekParameters law = {device.resistance_series_ohm, 0};
  return std::log(row.voltage_V / PointOf(device, row, law, 0).voltage_V);
}

bool IsBright(const TrendRow& row, const TrendOptions& options) {
  return row.state == TrendRowState::kUsed && row.irradiance_W_m2 >= options.least_irradiance_W_m2;
}

// Why these readings are none of the module at any light that its sensor may have missed; empty:
// they may be.
std::string DoubtOfPoint(const TrendDevice& device, const TrendRow& row) {
  constexpr double kMost = 3, kMost_W_m2 = 2000, kSun = 1.6;
  if (row.irradiance_W_m2 > kMost_W_m2) {
    return fmt::format("an irradiance of {:.4g} W/m2, expected at most {:g}", row.irradiance_W_m2,
                       kMost_W_m2);
  }
  const double voc = device.OpenCircuit(device.photocurrent_A, 25);
  const double volts = row.voltage_V / voc, amperes = row.current_A / device.photocurrent_A;
  const bool exchanged = row.current_A < kMost * voc && row.current_A > 0.3 * voc &&
                         row.voltage_V < kMost * device.photocurrent_A;
  if (exchanged && amperes > kMost) {
    return fmt::format("{:.4g} V and {:.4g} A: are the columns of voltage and current exchanged?",
                       row.voltage_V, row.current_A);
  }
  if (amperes > kMost || volts > kMost) {
    return fmt::format(
        "{:.4g} V and {:.4g} A, of a module of {:.3g} V and {:.3g} A: mA for A, or "
        "mV for V, or more than one module?",
        row.voltage_V, row.current_A, voc, device.photocurrent_A);
  }
  if (row.irradiance_W_m2 < kSun && amperes > 0.03) {
    return fmt::format("{:.4g} W/m2 with a current of {:.4g} A: kW/m2 for W/m2?",
                       row.irradiance_W_m2, row.current_A);
  }
  return "";
}

// Rows of each day, by time.
using RowsOfDay = std::map<int, std::vector<std::size_t>>;

RowsOfDay DaysOf(const std::vector<TrendRow>& rows, const TrendOptions& options, double length_s) {
  RowsOfDay days;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!IsBright(rows[i], options)) continue;
    days[static_cast<int>(std::floor(rows[i].time_s / length_s))].push_back(i);
  }
  return days;
}

// Medians of the ratios of the days around each day, four on either side.
std::map<int, double> MediansAround(const RowsOfDay& days, const std::vector<double>& ratios) {
  std::map<int, double> own, around;
  for (const auto& [day, rows] : days) {
    std::vector<double> values;
    for (const std::size_t i : rows) values.push_back(ratios[i]);
    own[day] = Median(values);
  }
  constexpr int kReach = 4;
  for (auto at = own.begin(); at != own.end(); ++at) {
    std::vector<double> near;
    auto begin = at, end = at;
    for (int k = 0; k < kReach && begin != own.begin(); ++k) --begin;
    for (int k = 0; k <= kReach && end != own.end(); ++k) ++end;
    for (auto k = begin; k != end; ++k) near.push_back(k->second);
    around[at->first] = Median(near);
  }
  return around;
}

// Marks whole substrings that are missing in the voltages of a day.
void MarkLost(const TrendDevice& device, const RowsOfDay& days, const std::vector<double>& ratios,
              double reference_end_s, std::vector<TrendRow>* rows) {
  constexpr int kMostTold = 8;
  constexpr double kNear = 0.35, kWholeDay = 0.8;
  if (device.substrings < 2 || device.substrings > kMostTold) return;
  std::vector<double> first;
  for (const auto& [day, of_day] : days) {
    for (const std::size_t i : of_day) {
      if ((*rows)[i].time_s <= reference_end_s) first.push_back(ratios[i]);
    }
  }
  const double usual = Median(first);
  for (const auto& [day, of_day] : days) {
    std::vector<double> own;
    for (const std::size_t i : of_day) own.push_back(ratios[i]);
    const double lost = device.substrings * (1 - std::exp(Median(own) - usual));
    const double whole = std::round(lost);
    if (whole < 1 || whole >= device.substrings || std::fabs(lost - whole) > kNear) continue;
    // Shade bypasses a substring for a part of the day, a shorted diode for all of it.
    const auto missing = std::count_if(own.begin(), own.end(), [&](double ratio) {
      return std::fabs(device.substrings * (1 - std::exp(ratio - usual)) - whole) <= kNear;
    });
    if (static_cast<double>(missing) < kWholeDay * static_cast<double>(own.size())) continue;
    for (const std::size_t i : of_day) (*rows)[i].lost_substrings = static_cast<int>(whole);
  }
}

// Marks rows off maximum power, and among them those at the limit of the inverter.
void MarkOff(const TrendDevice& device, const RowsOfDay& days, const std::vector<double>& ratios,
             std::vector<TrendRow>* rows) {
  std::vector<double> own = ratios;
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] -= std::log(Left(device, (*rows)[i]));
  }
  const std::map<int, double> around = MediansAround(days, own);
  std::vector<double> departures, powers;
  for (const auto& [day, of_day] : days) {
    for (const std::size_t i : of_day) {
      departures.push_back(own[i] - around.at(day));
      powers.push_back((*rows)[i].power_W());
    }
  }
  if (departures.empty()) return;
  constexpr double kLeast = 0.03, kTimes = 4, kAtLimit = 0.98;
  const double most = std::max(kLeast, kTimes * RobustScale(std::move(departures)));
  std::sort(powers.begin(), powers.end());
  const double highest = Quantile(powers, 0.998);
  for (const auto& [day, of_day] : days) {
    for (const std::size_t i : of_day) {
      const double departure = own[i] - around.at(day);
      if (std::fabs(departure) <= most) continue;
      const bool limited = departure > 0 && (*rows)[i].power_W() > kAtLimit * highest;
      (*rows)[i].state = limited ? TrendRowState::kLimited : TrendRowState::kOffMaximum;
    }
  }
}

// The equation of a row for series resistance and voltage, once its light is eliminated.
struct RowEquation {
  double series = 0;
  double voltage = 0;
  double rest = 0;
  double light = 0;         // at `week`
  double light_series = 0;  // its derivatives
  double light_voltage = 0;
};

RowEquation EquationOf(const TrendDevice& device, const TrendRow& row, const WeekParameters& week) {
  const double voltage = row.voltage_V / Left(device, row);
  const double step_light = 1e-3;
  const double step_ohm = 1e-3 * voltage / row.current_A;
  const double step_V = 1e-3 * voltage;
  // The light at which the current is the measured one.
  double light = 0;
  TrendPoint point;
  double by_light_I = 1, by_light_V = 0;
  for (int step = 0; step < 3; ++step) {
    point = PointOf(device, row, week, light);
    const TrendPoint lit = PointOf(device, row, week, light + step_light);
    by_light_I = std::log(lit.current_A / point.current_A) / step_light;
    by_light_V = std::log(lit.voltage_V / point.voltage_V) / step_light;
    light += std::log(row.current_A / point.current_A) / by_light_I;
  }
  point = PointOf(device, row, week, light);
  const TrendPoint resisted = PointOf(device, row, {week.series + step_ohm, week.voltage}, light);
  const TrendPoint lifted = PointOf(device, row, {week.series, week.voltage + step_V}, light);
  const auto slope = [](double stepped, double at, double step) {
    return std::log(stepped / at) / step;
  };
  RowEquation out;
  out.light = light;
  out.light_series = -slope(resisted.current_A, point.current_A, step_ohm) / by_light_I;
  out.light_voltage = -slope(lifted.current_A, point.current_A, step_V) / by_light_I;
  out.series = slope(resisted.voltage_V, point.voltage_V, step_ohm) + by_light_V * out.light_series;
  out.voltage = slope(lifted.voltage_V, point.voltage_V, step_V) + by_light_V * out.light_voltage;
  out.rest = std::log(voltage / point.voltage_V);
  return out;
}

// Robust least squares of a week; false: its rows do not tell both.
bool FitWeek(const TrendDevice& device, const std::vector<TrendRow>& rows,
             const std::vector<std::size_t>& of_week, WeekParameters* week) {
  if (of_week.size() < kLeastRows) return false;
  constexpr int kRounds = 6;
  constexpr double kHuber = 1.5;
  constexpr double kMostCondition = 1e3;
  Eigen::MatrixXd x(static_cast<Eigen::Index>(of_week.size()), 2);
  Eigen::VectorXd y(x.rows()), weight = Eigen::VectorXd::Ones(x.rows());
  const double ohm = rows[of_week.front()].voltage_V / rows[of_week.front()].current_A;
  const double volt = rows[of_week.front()].voltage_V;
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      const RowEquation one = EquationOf(device, rows[of_week[static_cast<std::size_t>(k)]], *week);
      x(k, 0) = one.series * ohm;
      x(k, 1) = one.voltage * volt;
      y[k] = one.rest;
    }
    const Eigen::VectorXd root = weight.cwiseSqrt();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * x);
    const auto diagonal = qr.matrixQR().diagonal().cwiseAbs();
    if (!(diagonal[1] * kMostCondition > diagonal[0])) return false;
    const Eigen::VectorXd change = qr.solve(root.cwiseProduct(y));
    const Eigen::VectorXd residuals = y - x * change;
    if (!change.allFinite()) return false;
    week->series = std::max(week->series + ohm * change[0], 0.0);
    week->voltage += volt * change[1];
    const double sigma = RobustScale({residuals.begin(), residuals.end()});
    if (!(sigma > 0)) break;
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      weight[k] = HuberWeight(std::fabs(residuals[k]) / sigma, kHuber);
    }
  }
  return std::isfinite(week->series) && std::isfinite(week->voltage);
}

void FillWeek(const TrendDevice& device, const WeekParameters& week, bool tells,
              const std::vector<std::size_t>& of_week, std::vector<TrendRow>* rows) {
  const double middle_s = (*rows)[of_week[of_week.size() / 2]].time_s;
  for (const std::size_t i : of_week) {
    TrendRow& row = (*rows)[i];
    row.parameters = ParametersOf(device, week, EquationOf(device, row, week).light);
    // A point that no light of the law gives is not at maximum power.
    if (!std::isfinite(row.parameters[kTrendLight])) row.state = TrendRowState::kOffMaximum;
    row.represents = tells && std::floor(row.time_s / kDay_s) == std::floor(middle_s / kDay_s);
  }
}

}  // namespace

void ReduceOperatingPoints(const TrendDevice& device, const TrendOptions& options,
                           std::vector<TrendRow>* rows) {
  std::stable_sort(rows->begin(), rows->end(), [](const TrendRow& one, const TrendRow& other) {
    return one.time_s < other.time_s;
  });
  for (TrendRow& row : *rows) {
    if (row.state != TrendRowState::kUsed) continue;
    row.reason = DoubtOfPoint(device, row);
    if (!row.reason.empty()) row.state = TrendRowState::kDoubtful;
  }
  for (TrendRow& row : *rows) {
    if (row.state == TrendRowState::kUsed && row.irradiance_W_m2 < options.least_irradiance_W_m2) {
      row.state = TrendRowState::kDim;
    }
  }
  const RowsOfDay days = DaysOf(*rows, options, kDay_s);
  if (days.empty()) return;
  std::vector<double> ratios(rows->size(), kUnknown);
  for (const auto& [day, of_day] : days) {
    for (const std::size_t i : of_day) ratios[i] = VoltageRatio(device, (*rows)[i]);
  }
  const double first_s = (*rows)[days.begin()->second.front()].time_s;
  MarkLost(device, days, ratios, first_s + options.reference_days * kDay_s, rows);
  MarkOff(device, days, ratios, rows);
  WeekParameters last = {device.resistance_series_ohm, 0};
  for (const auto& [week, of_week] : DaysOf(*rows, options, kWeek_s)) {
    WeekParameters own = last;
    const bool tells = FitWeek(device, *rows, of_week, &own);
    if (tells) last = own;
    FillWeek(device, tells ? own : last, tells, of_week, rows);
  }
}

}  // namespace lyrefit
