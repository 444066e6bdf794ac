// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// One header line, then one row for each run, in the order problem, algorithm, run. Studies with
// summarised problems have more columns at the end. RMSEs are in ampere, of the objective named in
// the row. Unknown values are empty fields. Fields with commas or quotation marks are quoted (RFC
// 4180). All columns except the seconds are the same on any number of threads.
std::string CompareCsv(const Comparison& comparison);

}  // namespace lyrefit
