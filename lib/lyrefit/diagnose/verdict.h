#pragma once

#include <string>

#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// What is found, from the fits, the values and the metadata, in words. `whiteness_after`: p-value
// of what the extended model leaves.
Verdict Decide(const Measurement& measurement, const Selection& selection,
               const DiagnoseOptions& options, double whiteness_after);

}  // namespace lyrefit
