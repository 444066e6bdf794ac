#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/coverage.h"

namespace LYREFIT_PUBLIC lyrefit {

// The coverage of the intervals as a CSV table, one row for each parameter. Unknown values are
// empty.
std::string CoverageCsv(const CoverageReport& report);

}  // namespace lyrefit
