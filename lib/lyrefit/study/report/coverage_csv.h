#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/coverage.h"

namespace LYREFIT_PUBLIC lyrefit {

// The coverage of the intervals as a table, a row a parameter; what is not known is empty.
std::string CoverageCsv(const CoverageReport& report);

}  // namespace lyrefit
