#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/sidecar.h"

namespace lyrefit {

// Sentences for what nobody said.
extern const char* const kCellsAssumed;
extern const char* const kTemperatureAssumed;
extern const char* const kIrradianceAssumed;

// What a sensor may show in the dark without being wrong.
constexpr double kLargestDarkOffset_W_m2 = 20;

// Sets conditions, notes and name from the sidecar and from the columns of the curve. A column and
// the sidecar that agree (2 % of irradiance, 1 K) leave the sidecar's round figure; where they
// differ the mean of the column counts, since it belongs to these very points.
void SettleConditions(const Sidecar& sidecar, IvCurve* curve);

// Makes currents of the current densities (A/cm2) of `curve` by the area that the options or the
// sidecar state. The error says how to state one.
Expected<void> SettleArea(const ReadOptions& options, const Sidecar& sidecar, IvCurve* curve);

// What the file beside a table says, completed by the head of the table; where they differ the file
// beside it counts, and the sentence says so.
Sidecar MergeHead(Sidecar beside, const Sidecar& head);

}  // namespace lyrefit
