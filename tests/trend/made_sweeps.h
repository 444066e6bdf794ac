#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/random.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/trend_device.h"
#include "lyrefit/trend/trend_series.h"

namespace lyrefit {

constexpr double kMadeStart_s = 20159 * kDay_s;  // 2025-03-12

// A module of 60 cells in three substrings with two diodes.
inline TrendDevice MadeDevice() {
  TrendDevice device;
  device.cells_in_series = 60;
  device.substrings = 3;
  device.n = 1;
  device.photocurrent_A = 9;
  device.resistance_series_ohm = 0.3;
  device.saturation_current_A = 1e-10;
  device.saturation_current_2_A = 3e-6;
  device.shunt_conductance_S = 1 / 400.0;
  device.isc_tempco_per_K = 5e-4;
  return device;
}

// The device in light and warmth, by its own law.
inline DeviceState MadeState(const TrendDevice& device, double irradiance_W_m2,
                             double temperature_C) {
  const double light_A = device.Photocurrent(irradiance_W_m2, temperature_C);
  TrendDevice first = device, second = device;
  first.saturation_current_2_A = 0;
  second.saturation_current_A = 0;
  const double a = device.ThermalVoltage(temperature_C);
  const double of_first = first.OpenCircuit(light_A, temperature_C);
  DeviceState state = {light_A, device.resistance_series_ohm, light_A * std::exp(-of_first / a), 0,
                       device.shunt_conductance_S};
  if (device.saturation_current_2_A > 0) {
    const double of_second = second.OpenCircuit(light_A, temperature_C);
    state.saturation_current_2_A = light_A * std::exp(-0.5 * of_second / a);
  }
  return state;
}

// The current at a voltage across the junction.
inline double JunctionCurrent(const TrendDevice& device, const DeviceState& state,
                              double junction_V, double temperature_C) {
  const double half = std::exp(0.5 * junction_V / device.ThermalVoltage(temperature_C));
  return state.photocurrent_A - state.saturation_current_A * half * half -
         state.saturation_current_2_A * half - state.shunt_conductance_S * junction_V;
}

// An exact sweep from short circuit to open circuit.
inline IvCurve MadeSweep(const TrendDevice& device, const DeviceState& state,
                         double irradiance_W_m2, double temperature_C, int points = 40) {
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = device.cells_in_series;
  curve.conditions.irradiance_W_m2 = irradiance_W_m2;
  curve.conditions.cell_temperature_K = temperature_C + kZeroCelsius_K;
  curve.notes.bypass_diodes = device.substrings;
  curve.notes.isc_tempco_per_K = device.isc_tempco_per_K;
  // The junction voltage at which the current is `share` of nothing, by halving.
  const auto junction_where = [&](const auto& beyond) {
    double low = 0, high = 2.0 * device.cells_in_series;
    for (int step = 0; step < 100; ++step) {
      const double middle = 0.5 * (low + high);
      (beyond(middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
  };
  const auto current_at = [&](double v) {
    return JunctionCurrent(device, state, v, temperature_C);
  };
  const double end = junction_where([&](double v) { return current_at(v) <= 0; });
  const double begin =
      junction_where([&](double v) { return v >= state.resistance_series_ohm * current_at(v); });
  for (int i = 0; i < points; ++i) {
    const double part = static_cast<double>(i) / (points - 1);
    const double junction = begin + (end - begin) * part * (1.6 - 0.6 * part);  // denser at the end
    const double current = current_at(junction);
    curve.current_A.push_back(current);
    curve.voltage_V.push_back(junction - current * state.resistance_series_ohm);
  }
  return curve;
}

// What a device has become on a day, from what it was at the start.
struct MadeChange {
  double light = 1;  // factors
  double series = 1;
  double recombination = 1;
  double shunt = 1;
  int lost_substrings = 0;
};

// Sweeps of days with changing weather, as instruments see them.
struct MadeYear {
  int days = 60;
  int per_day = 6;
  int points = 40;
  double noise = 3e-4;  // of a current, over Isc
  double light_error = 2e-3;
  double temperature_error_K = 0.15;
  std::uint64_t seed = 1;
  double dull_sensor = 0;  // what a sensor shows too much under a sky without any sun
  // Light of a day over that of a clear one.
  std::function<double(int day, RandomStream* random)> clearness = [](int, RandomStream* random) {
    return 0.55 + 0.45 * random->Uniform();
  };
  std::function<MadeChange(int day)> change = [](int) { return MadeChange(); };
};

inline TimedSweep MadeSweepOf(const TrendDevice& device, const MadeYear& year,
                              const MadeChange& now, double light, double time_s,
                              RandomStream* random) {
  const double irradiance = 1000 * light;
  const double temperature_C = 8 + 32 * light + 3 * random->Normal();
  DeviceState state = MadeState(device, irradiance, temperature_C);
  state.photocurrent_A *= now.light;
  state.resistance_series_ohm *= now.series;
  state.saturation_current_A *= now.recombination;
  state.saturation_current_2_A *= now.recombination;
  state.shunt_conductance_S *= now.shunt;
  TimedSweep sweep = {MadeSweep(device, state, irradiance, temperature_C, year.points), time_s};
  const double left = 1 - static_cast<double>(now.lost_substrings) / device.substrings;
  for (double& voltage : sweep.curve.voltage_V) voltage *= left;
  const double isc = sweep.curve.current_A.front();
  for (double& current : sweep.curve.current_A) current += year.noise * isc * random->Normal();
  Conditions& stated = sweep.curve.conditions;
  stated.irradiance_W_m2 *= 1 + year.light_error * random->Normal();
  stated.cell_temperature_K += year.temperature_error_K * random->Normal();
  return sweep;
}

inline std::vector<TimedSweep> MakeSweeps(const TrendDevice& device, const MadeYear& year) {
  RandomStream random(year.seed, 36);
  std::vector<TimedSweep> sweeps;
  for (int day = 0; day < year.days; ++day) {
    const double sky = year.clearness(day, &random);
    const MadeChange now = year.change(day);
    for (int k = 0; k < year.per_day; ++k) {
      const double hour = 9 + 7.0 * k / std::max(year.per_day - 1, 1);
      const double light = sky * std::sin(3.14159 * (hour - 5) / 14);
      sweeps.push_back(MadeSweepOf(device, year, now, light,
                                   kMadeStart_s + day * kDay_s + 3600 * hour, &random));
      sweeps.back().curve.conditions.irradiance_W_m2 *= 1 + year.dull_sensor * (1 - sky);
    }
  }
  return sweeps;
}

// The sweeps, reduced by a law.
inline TrendSeries ReducedBy(const TrendDevice& device, const std::vector<TimedSweep>& sweeps,
                             int threads = 1) {
  TrendSeries series;
  series.name = "made";
  series.law = "the test";
  series.device = std::make_shared<const TrendDevice>(device);
  AppendSweeps(sweeps, threads, &series);
  return series;
}

}  // namespace lyrefit
