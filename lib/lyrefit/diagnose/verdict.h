#pragma once

#include <string>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/measurement.h"

namespace lyrefit {

// What is found, from the fits, the values and the metadata, in words. `whiteness_after`: p-value
// of what the extended model leaves.
Verdict Decide(const Measurement& measurement, const Selection& selection, const AtReadings& at,
               const DiagnoseOptions& options, double whiteness_after);

}  // namespace lyrefit
