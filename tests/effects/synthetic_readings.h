#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/law.h"
#include "lyrefit/model/make_readings.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// Synthetic readings, one kind for each set of traits on which the testable effects depend.
enum class DataKind { kForward, kReverse, kUpDown, kLightAndDark, kFamily };
inline constexpr DataKind kDataKinds[] = {DataKind::kForward, DataKind::kReverse, DataKind::kUpDown,
                                          DataKind::kLightAndDark, DataKind::kFamily};

inline std::string NameOf(DataKind kind) {
  constexpr const char* kNames[] = {"Forward", "Reverse", "UpDown", "LightAndDark", "Family"};
  return kNames[static_cast<int>(kind)];
}

// A cell in current scales and volts per cell.
struct CellValues {
  double photocurrent = 1;
  double log_pivot = -0.1;  // ln of the first diode's current at the pivot voltage
  double ideality = 1.25;
  double resistance = 0.02;
  double conductance = 0.04;
  double second_pivot = 0.1;  // current of a second diode with n = 2 there
};

// Base parameters of a law for cells like this.
inline std::vector<double> ParametersOf(const CellValues& cell, const Readings& readings,
                                        Model model = Model::kSingleDiode) {
  const double scale = readings.scale.current_A, ohm = readings.scale.resistance_ohm();
  const double thermal = ThermalVoltage(readings.reference_temperature_K);
  const auto saturation = [&](double pivot, double n) {
    return scale * pivot / std::expm1(readings.pivot_voltage / (n * thermal));
  };
  std::vector<double> p = {cell.photocurrent * scale,
                           saturation(std::exp(cell.log_pivot), cell.ideality), cell.ideality,
                           cell.resistance * ohm, ohm / cell.conductance};
  if (model == Model::kDoubleDiode) p.insert(p.end(), {saturation(cell.second_pivot, 2), 2});
  return p;
}

inline void AppendSweep(double from, double to, int count, double irradiance, double temperature_K,
                        int curve, Readings* readings) {
  const int segment = readings->points.empty() ? 0 : readings->points.back().segment + 1;
  for (int k = 0; k < count; ++k) {
    Reading reading;
    reading.voltage = from + (to - from) * k / (count - 1);
    reading.irradiance = irradiance;
    reading.temperature_K = temperature_K;
    reading.curve = curve;
    reading.segment = segment;
    reading.rate = to > from ? 1.1 : -0.9;
    reading.index = k;
    reading.dark = irradiance == 0;
    readings->points.push_back(reading);
  }
}

inline void AppendSweeps(DataKind kind, Readings* readings) {
  constexpr double kTop = 0.66, kRoom_K = 298.15;
  DataTraits& traits = readings->traits;
  traits.lowest_voltage = 0;
  traits.highest_voltage = kTop;
  traits.temperature_levels = traits.irradiance_levels = 1;
  switch (kind) {
    case DataKind::kForward:
      return AppendSweep(0, kTop, 41, 1, kRoom_K, 0, readings);
    case DataKind::kReverse:
      traits.reverse = true;
      traits.lowest_voltage = -6;
      AppendSweep(-6, -0.1, 20, 1, kRoom_K, 0, readings);
      AppendSweep(0, kTop, 31, 1, kRoom_K, 0, readings);
      for (Reading& reading : readings->points) reading.segment = 0;
      return;
    case DataKind::kUpDown:
      traits.up_down = true;
      AppendSweep(0, kTop, 31, 1, kRoom_K, 0, readings);
      return AppendSweep(kTop, 0, 31, 1, kRoom_K, 0, readings);
    case DataKind::kLightAndDark:
      traits.dark = true;
      traits.single = false;
      traits.curves = 2;
      AppendSweep(0, kTop, 31, 1, kRoom_K, 0, readings);
      return AppendSweep(-0.3, kTop, 31, 0, kRoom_K, 1, readings);
    case DataKind::kFamily:
      traits.single = false;
      traits.curves = 6;
      traits.irradiance_levels = 3;
      traits.temperature_levels = 2;
      for (int c = 0; c < 6; ++c) {
        const bool hot = c > 2;
        AppendSweep(0, hot ? kTop - 0.08 : kTop, 15, 0.2 + 0.4 * (c % 3), hot ? 333.15 : kRoom_K, c,
                    readings);
      }
  }
}

// Readings whose currents are those of the ordinary cell.
inline Readings SyntheticReadings(DataKind kind, int cells) {
  Readings readings;
  AppendSweeps(kind, &readings);
  const int count = static_cast<int>(readings.points.size());
  for (int k = 0; k < count; ++k) {
    readings.points[k].x = (k + 0.3) / count - 0.5;
  }
  readings.scale.current_A = 8.2;
  readings.scale.cells = cells;
  readings.scale.rate_V_per_s = 0.7;
  readings.scale.times = true;
  readings.scale.span_s = 1.4;
  readings.isc_tempco_per_K = 0.0005;
  readings.pivot_voltage = 0.6;
  DataTraits& traits = readings.traits;
  traits.beyond_voc = true;
  traits.module = cells > 1;
  traits.cells = cells;
  traits.open_circuit = 0.6;
  traits.readings = count;
  traits.thermal_voltage = ThermalVoltage(readings.reference_temperature_K);
  for (int k = 1; traits.single && k + 2 < count; ++k) {
    traits.step_times.push_back(0.5 * (readings.points[k].x + readings.points[k + 1].x));
  }
  readings.scale.reach_V = std::max(-traits.lowest_voltage, traits.highest_voltage);
  readings.scale.saturation_2_unit = Saturation2Unit(readings);
  LawWorkspace workspace;
  std::vector<double> current(count);
  EXPECT_TRUE(EvaluateLaw(Law{}, readings, ParametersOf({}, readings).data(), &workspace,
                          current.data(), {}));
  for (int k = 0; k < count; ++k) readings.points[k].current = current[k];
  SetRangeCurrents(&readings);
  return readings;
}

// A law with an effect, and its parameters: those of an ordinary cell and of the effect.
struct Settled {
  Law law;
  std::vector<double> p;
};

inline Settled WithEffect(const Effect& effect, const std::vector<double>& values,
                          const Readings& readings) {
  Settled settled{Law{}, ParametersOf({}, readings)};
  settled.law.effects = {&effect};
  EXPECT_EQ(static_cast<int>(values.size()), effect.size()) << effect.id;
  settled.p.insert(settled.p.end(), values.begin(), values.end());
  return settled;
}

inline std::vector<double> NeutralValues(const Effect& effect) {
  std::vector<double> values;
  for (const EffectParameter& parameter : effect.parameters) values.push_back(parameter.neutral);
  return values;
}

// Currents of all readings; empty if the law cannot be evaluated.
inline std::vector<double> Currents(const Law& law, const Readings& readings,
                                    const std::vector<double>& p) {
  LawWorkspace workspace;
  std::vector<double> current(readings.points.size());
  const bool fine = EvaluateLaw(law, readings, p.data(), &workspace, current.data(), nullptr);
  return fine ? current : std::vector<double>();
}

// Derivatives of all readings, row by row; empty if the law cannot be evaluated.
inline std::vector<double> Jacobian(const Law& law, const Readings& readings,
                                    const std::vector<double>& p) {
  LawWorkspace workspace;
  std::vector<double> current(readings.points.size()), jacobian(current.size() * law.size());
  const bool fine =
      EvaluateLaw(law, readings, p.data(), &workspace, current.data(), jacobian.data());
  return fine ? jacobian : std::vector<double>();
}

}  // namespace lyrefit
