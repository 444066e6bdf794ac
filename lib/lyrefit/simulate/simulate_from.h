// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/simulate.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reads model, parameters, conditions, constants and effects from a JSON fit report, ready for
// Simulate(). With effects, the readings of the report are reproduced to 1e-9 of their currents.
// `curve` is the id of one curve in a report of many, such as those of a family or a diagnosis. An
// infinite shunt resistance, null in JSON, is read back as infinite. Errors: an unreadable report,
// an unknown effect, effects in a report of another version of lyrefit, no such curve.
Expected<SimulateOptions> ReadFitForSimulation(const std::string& path,
                                               const std::string& curve = "");
// ReadFitForSimulation() for the text of a report; errors name it `path`.
Expected<SimulateOptions> ReadFitTextForSimulation(const std::string& text, const std::string& path,
                                                   const std::string& curve = "");

}  // namespace lyrefit
