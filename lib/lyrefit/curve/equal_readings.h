#pragma once

#include <vector>

#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Runs of exactly equal currents or voltages at an end of the curve that a coarse instrument does
// not explain: a limit of the source or the load. All are doubts, with their points.
//
// Equal currents at the high end need a slope before them that goes on nowhere; at the low end,
// where an illuminated device is flat by nature and a coarse instrument repeats itself, they need a
// corner sharper than a diode's. Equal voltages need currents
// that differ, and readings elsewhere that do not repeat.
std::vector<ReadingFinding> FindEqualReadings(const IvCurve& curve);

}  // namespace lyrefit
