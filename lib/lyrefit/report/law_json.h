#pragma once

#include <vector>

#include "lyrefit/law/extension.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

// Effects and the measurement of many curves in which they act, so that whoever reads the report
// can simulate each of them. `shared`: one law stands behind all; without it each curve has its
// own.
Json SetLawJson(const std::vector<EffectUse>& with, const CurveSet& set, const Extension* shared);

}  // namespace lyrefit
