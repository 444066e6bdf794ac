#pragma once

#include "lyrefit/curve/iv_curve.h"
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

}  // namespace lyrefit
