#pragma once

#include <string>

#include "lyrefit/study/coverage.h"

namespace lyrefit {

// Everything, with the truth and the interval of every set.
std::string CoverageJson(const CoverageReport& report);

}  // namespace lyrefit
