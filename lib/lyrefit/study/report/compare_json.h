// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// The comparison as one JSON object, every run included. Numbers have enough digits to restore the
// same bits. The four stages have the same names as in the report of a fit. Unknown and non-finite
// values are null. Every wall-clock time is under a key named `seconds`. Apart from those the same
// seed gives the same text on any number of threads.
std::string CompareJson(const Comparison& comparison);

}  // namespace lyrefit
