#pragma once

#include <array>

#include "lyrefit/trend/trend_device.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Parameters of a device in one condition, in the order of TrendParameter: photocurrent in A, Rs in
// ohm, ln of the saturation current in A at 25 C, shunt conductance in S.
using TrendState = std::array<double, kTrendParameters>;

// Splits the difference between the power of `before` and that of `after` into the shares of the
// four parameters: Shapley's value, the mean over all orders in which they may be exchanged
// (Shapley 1953, "A value for n-person games"). The shares add up to the difference.
std::array<double, kTrendParameters> SplitLoss(const TrendDevice& device, const TrendState& before,
                                               const TrendState& after, double temperature_C);

// Power at maximum power in W.
double PowerOf(const TrendDevice& device, const TrendState& state, double temperature_C);

}  // namespace lyrefit
