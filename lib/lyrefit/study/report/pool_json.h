#pragma once

#include "lyrefit/report/json_parts.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Problems that are summed up over their devices (study/problem_summary.h), an object each, and the ranks of
// their searches; an empty object where there are none. What follows from wall-clock times stands
// under a key named `seconds` too.
Json PoolsJson(const Comparison& comparison);

}  // namespace lyrefit
