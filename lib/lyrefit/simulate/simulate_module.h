// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/read/condition_options.h"
#include "lyrefit/read/read_pvlib.h"

namespace LYREFIT_PUBLIC lyrefit {

// The device of a module by its law at the stated conditions, ready for Simulate(). Conditions that
// are not stated are 1000 W/m2 and 25 C. Errors: those of ApplyConditions; another number of cells
// than the module has; no light.
Expected<SimulateOptions> SimulationOf(const NamedParameters& module,
                                       const ConditionOptions& stated);

// A device to simulate from a file, and sentences about the file for the user.
struct DeviceToSimulate {
  SimulateOptions options;
  std::vector<std::string> warnings;
};

// Reads a module (read_module.h), at the stated conditions, or a JSON fit report
// (ReadFitForSimulation), at its own. `curve` is the id of one curve in a report of many; a report
// of a family without it is a module by its law where irradiance and temperature are stated.
Expected<DeviceToSimulate> ReadForSimulation(const std::string& file, const std::string& curve,
                                             const ConditionOptions& stated);
// The same of the text of a JSON fit report. `path`: for errors.
Expected<SimulateOptions> ReadReportForSimulation(const std::string& text, const std::string& path,
                                                  const std::string& curve,
                                                  const ConditionOptions& stated);

}  // namespace lyrefit
