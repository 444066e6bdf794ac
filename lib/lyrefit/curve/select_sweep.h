#pragma once

#include <optional>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Leaves in `curve` the rows of the wanted number of its sweep column. Without a wish the file must
// hold one sweep, or sweeps in both directions at one irradiance (within 2 %) and temperature
// (within 1 K), which stay together; `holds_curves` says that the numbers tell curves apart, which
// never do.
Expected<void> SelectSweep(std::optional<int> wanted, bool holds_curves, IvCurve* curve);

// Whether the sweeps of `curve` differ in irradiance or temperature by more than that.
bool SweepsDifferInConditions(const IvCurve& curve);

}  // namespace lyrefit
