#pragma once

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Voltage of `cells` cells in series at a current, without series resistance, at 25 C. n = 1.1 and
// Voc is 0.64 V per cell at 9 A. A bypass diode limits the voltage to about -0.5 V.
inline double SubstringVoltage(double current_A, double photocurrent_A, int cells) {
  const double thermal_V = 1.1 * 0.0257 * cells, saturation_A = 9 / std::exp(0.64 / (1.1 * 0.0257));
  const double shunt_ohm = 8.0 * cells;
  double low = -0.5, high = 1.0 * cells;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    const double delivered =
        photocurrent_A - saturation_A * std::expm1(middle / thermal_V) - middle / shunt_ohm;
    (delivered > current_A ? low : high) = middle;
  }
  return low - current_A * 0.005 * cells;
}

// A 60-cell module of three substrings, each with its own light (1 means 9 A): `points` equidistant
// voltages from 0 to 39 V, Gaussian noise of 2 mA.
inline IvCurve SyntheticModule(double first = 1, double second = 1, double third = 1,
                               int points = 100) {
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = 60;
  RandomStream random(1);
  for (int k = 0; k < points; ++k) {
    const double voltage_V = 39.0 * k / (points - 1);
    double low = -60, high = 9.5;
    for (int step = 0; step < 100; ++step) {
      const double middle = (low + high) / 2;
      double reached_V = 0;
      for (const double light : {first, second, third}) {
        reached_V += SubstringVoltage(middle, 9 * light, 20);
      }
      (reached_V > voltage_V ? low : high) = middle;
    }
    curve.voltage_V.push_back(voltage_V);
    curve.current_A.push_back(low + 0.002 * random.Normal());
  }
  return curve;
}

// A single cell from -0.1 to 0.69 V in steps of 10 mV; photocurrent 0.15 A times `light`, noise of
// 30 uA.
inline IvCurve SyntheticCell(double light = 1) {
  IvCurve curve;
  curve.name = "cell";
  RandomStream random(1);
  for (int k = -10; k < 70; ++k) {
    const double voltage_V = 0.01 * k;
    double low = -2, high = 1;
    for (int step = 0; step < 100; ++step) {
      const double middle = (low + high) / 2;
      const double junction_V = voltage_V + 0.15 * middle;
      const double delivered =
          0.15 * light - 4e-10 * std::expm1(junction_V / 0.0308) - junction_V / 3000;
      (delivered > middle ? low : high) = middle;
    }
    curve.voltage_V.push_back(voltage_V);
    curve.current_A.push_back(low + 3e-5 * random.Normal());
  }
  return curve;
}

}  // namespace lyrefit
