#pragma once

#include "lyrefit/report/json_parts.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Problems that are summarised over their devices (study/problem_summary.h), one object each, and
// the ranks of their searches. Empty object: there are none. Values that depend on wall-clock times
// are also under a key named `seconds`.
Json ProblemsJson(const Comparison& comparison);

}  // namespace lyrefit
