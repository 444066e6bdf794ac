#pragma once

#include <array>
#include <vector>

#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// How a parameter that a law takes as constant follows light and temperature in truth (two diodes
// in place of one, a sensor that lags): linear in features of the conditions, 0 at 1000 W/m2 and
// 25 C. The coefficients are found from differences within blocks of neighbouring measurements
// (days), so that no trend and no season gets into them.
constexpr int kConditionFeatures = 5;
using Features = std::array<double, kConditionFeatures>;

// t = (T - 25 C) / 10 K, ln g, (ln g)^2, t ln g, t^2 for the light g on the device, as a part of
// 1000 W/m2.
Features FeaturesAt(double light, double temperature_C);

// Features of the light that a device gets of what its sensor shows: t, 1 - c, c (1 - h)^4, 0, 0 for
// a clearness c and a height h (clearness.h). Under a dull sky and in grazing light sensor and device
// answer differently.
Features SkyFeaturesAt(double temperature_C, double clearness, double height);

// The sum of coefficients times features.
double Departure(const Features& coefficients, const Features& features);

// A value of one measurement, with its block.
struct ConditionedValue {
  int block = 0;  // ascending
  Features features{};
  double value = 0;
};

// Coefficients by robust regression (Huber) with one level for each block. All 0 if the blocks have
// too few values.
Features FitWithinBlocks(const std::vector<ConditionedValue>& values);

// The robust mean of one block (Huber), less the departures.
double BlockMean(const std::vector<ConditionedValue>& values, const Features& coefficients);

}  // namespace lyrefit
