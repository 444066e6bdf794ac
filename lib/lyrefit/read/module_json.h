#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

// The sheet of a module in JSON, and its text for the places of errors.
struct ModuleJson {  // NOLINT(bugprone-exception-escape): nlohmann's destructor
  std::string text;
  nlohmann::json json;
};

// Reads a sheet. Errors: no JSON object, a key that no sheet has; the message lists all that are
// known.
Expected<ModuleJson> ReadModuleJson(const std::string& file);

}  // namespace lyrefit
