#pragma once

#include <optional>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Keeps the rows of the sweep number `wanted`. If unset, the file must hold one sweep, or sweeps in
// both directions at one irradiance (within 2 %) and temperature (within 1 K), which are kept
// together. With `holds_curves` the numbers denote different curves, which are never kept together.
// Errors: no such sweep, or several that need a selection.
Expected<void> SelectSweep(std::optional<int> wanted, bool holds_curves, IvCurve* curve);

// Whether the sweeps differ by more than 2 % in irradiance or 1 K in temperature.
bool SweepsDifferInConditions(const IvCurve& curve);

}  // namespace lyrefit
