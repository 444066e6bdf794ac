#pragma once

#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// IEC 60891:2021, procedure 3: between curves 1 and 2 of the same device, or beyond them,
//   V3 = V1 + a (V2 - V1),   I3 = I1 + a (I2 - I1)   for points with I2 - I1 = Isc2 - Isc1,
//   G3 = G1 + a (G2 - G1),   T3 = T1 + a (T2 - T1).
// Two curves reach what lies on one line of (G, T); with a third one, first a point on the line of
// 2 and 3 that lies in line with 1 and the target, then the target.
// Errors: no further curve, a target off the line (beyond 2 % of the light or 1 K), one further
// beyond the curves than they are apart.
Expected<CurvePoints> BetweenCurves(const PreparedCurve& curve, const TranslationInputs& inputs);

// How far along 0 (the curve) .. 1 (the further one) the target lies; of a third curve the larger
// of both steps. NaN where BetweenCurves has nothing to say.
double PlaceBetween(const PreparedCurve& curve, const TranslationInputs& inputs);

}  // namespace lyrefit
