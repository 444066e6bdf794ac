#pragma once

#include <array>

#include "lyrefit/trend/trend_device.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Splits the difference between the power of `before` and that of `after` into the shares of light,
// series resistance, recombination and shunt: Shapley's value, the mean over all orders in which
// they may be exchanged (Shapley 1953, "A value for n-person games"). The shares, by TrendPart, add
// up to the difference; that of mismatch is 0.
std::array<double, kTrendParts> SplitLoss(const TrendDevice& device, const DeviceState& before,
                                          const DeviceState& after, double temperature_C);

}  // namespace lyrefit
