#pragma once

#include <string>

#include "command_line.h"
#include "lyrefit/fit/bounds.h"

namespace lyrefit {

// --bounds, as every verb that fits understands it: those published for a curve lie beside it.
void AddBoundsFlag(VerbLine* verb, const std::string& group, std::string* name);
void AddBoundsFlag(VerbLine* verb, const std::string& group, const std::string& by_default,
                   std::string* name);

// What it names for the curve in `curve_file`; errors name the flag, or the file.
Expected<BoundsSpec> FlaggedBounds(const std::string& name, const std::string& curve_file);

}  // namespace lyrefit
