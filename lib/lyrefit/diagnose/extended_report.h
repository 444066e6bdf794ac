#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/observer.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/average.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {

// The extended law as a FitReport: base parameters in pvlib's units, then those of the causes. With
// `search`, the modified lyrebird optimizer searches the box of the whole law, and its best
// candidate is polished as well. A random search of the same budget is run for comparison.
FitReport ExtendedReport(const CurveSet& set, const Selection& selection, const AtReadings& at,
                         bool search, std::uint64_t seed, const Observer& observer);

}  // namespace lyrefit
