#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// One header line (of a study with pooled problems with more columns at its end),
// then one row a run, in the order problem, algorithm, run. RMSEs are of the objective named in the
// row, in ampere. What is not known is an empty field; fields with commas or quotation marks are
// quoted (RFC 4180). All but the columns of seconds are the same on any number of threads.
std::string CompareCsv(const Comparison& comparison);

}  // namespace lyrefit
