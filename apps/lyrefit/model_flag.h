#pragma once

#include "command_line.h"
#include "lyrefit/law/device.h"

namespace lyrefit {

// --model, as the verbs understand it that may leave the number of diodes to the data.
void AddModelFlag(VerbLine* verb, Model* model, bool* automatic);

}  // namespace lyrefit
