#pragma once

#include "command_line.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Declares --model for a verb that can select the number of diodes from the data.
void AddModelFlag(VerbLine* verb, Model* model, bool* automatic);

}  // namespace lyrefit
