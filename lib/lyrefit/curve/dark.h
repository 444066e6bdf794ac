#pragma once

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Whether a curve was measured in the dark, without photocurrent. A photocurrent is a positive
// current, in generator sign, at the voltage nearest to 0 V. It counts as one
//   - of a curve stated as dark (irradiance 0): above 5 % of the largest |current|, since less may
//     be an offset of the meter,
//   - of any other: above 0.2 % of it (5 %, if the readings next to 0 V change their sign by turns,
//     as noise does, and no light is stated), or above 30 times the noise of the readings next to 0 V (5
//     times, if light of more than 20 W/m2 is stated). Specified offsets of meters are up to some
//     20 times their noise in the same range.
bool IsDark(const IvCurve& curve);

// Whether a curve was logged without light and without a current driven into the device, as at night:
// the stated irradiance is at most 20 W/m2, and no current exceeds 10 times the noise of the readings
// next to 0 V.
bool IsNight(const IvCurve& curve);

// Whether the irradiance is stated, and as 0.
bool IsStatedDark(const IvCurve& curve);

}  // namespace lyrefit
