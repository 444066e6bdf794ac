// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/curve/data_sheet.h"

namespace LYREFIT_PUBLIC lyrefit {

// The data sheet of a module as a file of another program repeats it.
struct ModuleSheet {
  std::string name;  // manufacturer and model; empty: not stated
  DataSheet sheet;   // values that are not stated are NaN; rounded as their digits say
  std::optional<double> rated_power_W;
  bool has_model = false;                // the file states a device of its own too
  std::vector<std::string> assumptions;  // how values that it does not state were found
};

}  // namespace lyrefit
