#pragma once

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Whether a curve was measured in the dark, without photocurrent. The current at the voltage
// nearest to 0 V is compared with the largest |current|. A curve stated as dark (irradiance 0) is
// dark up to 5 %, which may be an offset of the meter. Any other curve is dark up to 0.2 %.
bool IsDark(const IvCurve& curve);

// Whether the irradiance is stated, and as 0.
bool IsStatedDark(const IvCurve& curve);

}  // namespace lyrefit
