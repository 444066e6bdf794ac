#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/sidecar.h"

namespace lyrefit {

// Sentences about assumed default values.
extern const char* const kCellsAssumed;
extern const char* const kTemperatureAssumed;
extern const char* const kIrradianceAssumed;

// Largest magnitude of a negative reading that a correct irradiance sensor may show in the dark.
constexpr double kLargestDarkOffset_W_m2 = 100;

// Takes irradiances below zero, which sensors show at night, as 0, and says how many they were.
void TakeNightAsDark(std::vector<double>* irradiance_W_m2, std::vector<Assumption>* assumptions);

// Fills curve->stated_in where a condition is known and nothing says from where: from a column, or
// "the file".
void SaySources(IvCurve* curve);

// Sets conditions, notes and name from the sidecar and the columns of the curve. If a column's mean
// agrees with the sidecar (2 % of irradiance, 1 K), the sidecar's rounded value is kept. Otherwise
// the mean is used, since the column belongs to these points.
void SettleConditions(const Sidecar& sidecar, IvCurve* curve);

// Converts the current densities of `curve` from A/cm2 to A by the area in the options or the
// sidecar. Error: no area or an invalid one; the message explains how to state it.
Expected<void> SettleArea(const ReadOptions& options, const Sidecar& sidecar, IvCurve* curve);

// Completes the sidecar beside a table by the head of the table. If they differ, the sidecar has
// priority, and `assumptions` mentions it.
Sidecar MergeHead(Sidecar beside, const Sidecar& head);

}  // namespace lyrefit
