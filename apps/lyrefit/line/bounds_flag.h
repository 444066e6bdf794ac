#pragma once

#include <string>

#include "command_line.h"
#include "lyrefit/estimate/fit/bounds.h"

namespace lyrefit {

// Declares --bounds for a verb that fits. Published bounds of a curve are in a file beside the
// curve.
void AddBoundsFlag(VerbLine* verb, const std::string& group, std::string* name);
void AddBoundsFlag(VerbLine* verb, const std::string& group, const std::string& by_default,
                   std::string* name);

// Bounds of this `name` for the curve in `curve_file`. Errors name the flag or the file.
Expected<BoundsSpec> FlaggedBounds(const std::string& name, const std::string& curve_file);

}  // namespace lyrefit
