// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Completes readings without a file: `readings` holds a name and columns. Currents in load sign are
// negated. Without columns that state otherwise, the curve is of one cell at 25 C and 1000 W/m2;
// `assumptions` names each of these defaults. The result is not checked: see Validate.
IvCurve BareCurve(IvCurve readings);

}  // namespace lyrefit
