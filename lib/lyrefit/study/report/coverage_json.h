#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/coverage.h"

namespace LYREFIT_PUBLIC lyrefit {

// The complete report as JSON, with the true value and the interval of every set.
std::string CoverageJson(const CoverageReport& report);

}  // namespace lyrefit
