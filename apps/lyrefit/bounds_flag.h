#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "lyrefit/fit/bounds.h"

namespace lyrefit {

// --bounds and --bound, as every verb that fits understands them.
struct BoundsFlags {
  std::string name = "physical";
  std::vector<std::string> ranges;  // "Rs=0:0.5"
};

void AddBoundsFlags(Verb* verb, const std::string& group, BoundsFlags* flags);

// The bounds for the curve in `curve_file`; those published for a data set lie beside its curve.
Expected<BoundsSpec> BoundsFromFlags(const BoundsFlags& flags, const std::string& curve_file);

}  // namespace lyrefit
