#pragma once

#include <string>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/measurement.h"

namespace lyrefit {

// Combines fits, values and metadata into a verdict. `whiteness_after`: p-value of the whiteness
// test of the extended model's residuals.
Verdict Decide(const Measurement& measurement, const Selection& selection, const AtReadings& at,
               const DiagnoseOptions& options, double whiteness_after);

}  // namespace lyrefit
