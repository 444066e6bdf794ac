#pragma once

#include <memory>
#include <string>

#include "lyrefit/base/error.h"
#include "plant/string_plan.h"

namespace lyrefit {

// Reads the data sheet of a module, see ReadPlantPlan, and finds its device. Errors: those of
// reading, a value that is missing, a sheet that no diode describes.
Expected<std::shared_ptr<const PlannedModule>> ReadPlannedModule(const std::string& file);

}  // namespace lyrefit
