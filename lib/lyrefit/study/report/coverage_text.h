#pragma once

#include <string>

#include "lyrefit/study/coverage.h"

namespace lyrefit {

// What a coverage study says to a terminal of 100 columns; ends with a newline.
std::string CoverageText(const CoverageReport& report);

// Everything, with the truth and the interval of every set.
std::string CoverageJson(const CoverageReport& report);

}  // namespace lyrefit
