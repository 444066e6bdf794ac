#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/devices/cell_report.h"

namespace lyrefit {

// The results that a file states for a sweep, beside the figures of the sweep in the same units.
// Results of other quantities, such as resistances, whose definitions differ, are left out.
// `area_cm2` may be NaN. A voltage or a power without a unit is in V and mW/cm2, or in mV and mW
// where those are nearer.
std::vector<StatedKeyPoint> CompareStated(const std::vector<StatedResult>& results,
                                          const CellSweep& sweep, double area_cm2);

}  // namespace lyrefit
