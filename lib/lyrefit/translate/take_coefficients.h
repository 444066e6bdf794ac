#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/translate/device_coefficients.h"

namespace lyrefit {

// Takes the coefficients of ReadCoefficients, or none, from a JSON object. Values that are set in
// `coefficients` already are kept. Error: a value that is no number.
Expected<void> TakeCoefficients(const nlohmann::json& document, const std::string& text,
                                const std::string& path, StatedCoefficients* coefficients);

}  // namespace lyrefit
