#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// What becomes of readings that no file says anything about: `readings` holds its name and columns.
// Load sign is turned, and it is one cell at 25 C under 1000 W/m2 unless the columns say otherwise;
// each of these `assumptions` says until somebody states it. Not checked: see Validate.
IvCurve BareCurve(IvCurve readings);

}  // namespace lyrefit
