#pragma once

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Whether a curve was taken in the dark: it has no photocurrent. A curve that is stated as dark
// (irradiance 0) has one where it delivers at 0 V more than an offset of the meter could be (5 % of
// its largest current), any other where it delivers 0.2 %.
bool IsDark(const IvCurve& curve);

// Whether somebody stated that it was.
bool IsStatedDark(const IvCurve& curve);

}  // namespace lyrefit
