#pragma once

#include <cstddef>
#include <vector>

#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Finds runs of exactly equal currents or voltages at an end of the curve. Such a run is a limit of
// the source or the load unless the resolution of the instrument explains it. All findings are
// doubts and list their points.
//
// Equal currents at the high-voltage end are a finding if the slope before them would have
// continued visibly. An illuminated device is flat at the low-voltage end, and a coarse instrument
// repeats readings there. Equal currents there are a finding only after a corner sharper than a
// diode's. Equal voltages are a finding if their currents differ and no readings elsewhere repeat.
std::vector<ReadingFinding> FindEqualReadings(const IvCurve& curve);

// Leaves out the readings at the stated current limit of the source (compliance_A): those from the
// highest voltage down whose current is against the generator and within 0.2 % of the limit. Says
// so in `assumptions`. Does nothing if fewer than four readings would remain.
void LeaveOutLimited(IvCurve* curve);

// Leaves out the rows at the end, from row `begin` on, that hold exactly 0 V and 0 A although the
// sweep does not come there: a shorter column of a table is padded with them. Returns their number.
std::size_t LeaveOutPadding(std::size_t begin, IvCurve* curve);

// Whether readings are whole numbers, and large ones, as the registers of an inverter hold them.
bool AreWholeNumbers(const std::vector<double>& readings);

}  // namespace lyrefit
