#pragma once

#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Refuses options that do not go with weighing by errors.
Expected<void> CheckErrorSpec(const FitOptions& options);

// The options that are not at their defaults.
void EchoOptions(const FitOptions& options, FitReport* report);

}  // namespace lyrefit
