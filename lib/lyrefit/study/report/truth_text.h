#pragma once

#include <string>

#include "lyrefit/study/truth.h"

namespace lyrefit {

// Fits held against known parameters, for a terminal of 100 columns; ends with a newline.
std::string TruthText(const TruthComparison& comparison);

}  // namespace lyrefit
