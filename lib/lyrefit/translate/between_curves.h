#pragma once

#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// Points by IEC 60891:2021, procedure 3, between curves 1 and 2 of one device, or beyond them:
//   V3 = V1 + a (V2 - V1),   I3 = I1 + a (I2 - I1)   for points with I2 - I1 = Isc2 - Isc1,
//   G3 = G1 + a (G2 - G1),   T3 = T1 + a (T2 - T1).
// Two curves reach the targets on one line of (G, T). With a third curve, the first step goes to
// the point on the line of 2 and 3 that is collinear with 1 and the target; the second goes to the
// target. Errors: no further curve; a target off the line by more than 2 % of its irradiance or 1
// K; a target further beyond the curves than the distance between them.
Expected<CurvePoints> BetweenCurves(const PreparedCurve& curve, const TranslationInputs& inputs);

// Position of the target from 0 (the measured curve) to 1 (the further one); with a third curve the
// larger of both steps. NaN where BetweenCurves fails.
double PlaceBetween(const PreparedCurve& curve, const TranslationInputs& inputs);

}  // namespace lyrefit
