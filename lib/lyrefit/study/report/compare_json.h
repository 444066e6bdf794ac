#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// The comparison as one JSON object, every run included, numbers with as many digits as bring back
// the same bits; the four stages are named as in the report of a fit. What is not known or not
// finite is null. Every wall-clock time stands under a key named `seconds`; apart from those the
// same seed gives the same text on any number of threads.
std::string CompareJson(const Comparison& comparison);

}  // namespace lyrefit
