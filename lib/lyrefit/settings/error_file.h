// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/error_spec.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reads a file like {"current_noise_A": 0.001, "voltage_noise_V": 0.01, "path_of_isc": 0.0012}. All
// three keys are required, none below 0, and the first or the last above 0. "path_length_of_voc",
// above 0, is optional and defaults to 1. Errors carry file, line and column.
Expected<ErrorSpec> ReadErrorFile(const std::string& path);

// Error model by name ("white" or "field"), or from a file of ReadErrorFile(). Errors: those of the
// file.
Expected<ErrorSpec> ErrorsNamed(const std::string& name);

}  // namespace lyrefit
