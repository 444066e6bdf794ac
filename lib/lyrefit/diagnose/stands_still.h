#pragma once

#include "lyrefit/diagnose/workbench.h"

namespace lyrefit {

// Whether a reading at an end of its stretch is what the law says of a voltage that stands still.
// Where a sweep begins, turns or ends its rate is not what neighbours say: beside a charge or a
// skew such a reading is off, but not wrong.
bool StandsStill(const Workbench& bench, const LawFit& fit, int reading);

}  // namespace lyrefit
