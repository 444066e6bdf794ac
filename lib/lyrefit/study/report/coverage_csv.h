#pragma once

#include <string>

#include "lyrefit/study/coverage.h"

namespace lyrefit {

// The coverage of the intervals as a table, a row a parameter; what is not known is empty.
std::string CoverageCsv(const CoverageReport& report);

}  // namespace lyrefit
