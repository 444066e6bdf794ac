// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/bounds.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reads a bounds file: {"Iph":[0,2],"Is":[0,5e-5],"n":[1,2],"Rs":[0,0.36],"Rsh":[0,1000]}. Ampere
// and ohm of the whole device, n per cell. Errors carry file, line and column.
Expected<BoundsSpec> ReadBoundsFile(const std::string& path);

// Bounds by name: "physical", "wide", the path of a bounds file, or "table1" or "literature". The
// last two are read from bounds-paper.json and bounds-literature.json beside the file of the curve
// (or in its folder). "paper" is the former name of "table1". Errors without a file begin with
// "bounds".
Expected<BoundsSpec> NamedBounds(const std::string& name, const std::string& curve_file);

}  // namespace lyrefit
