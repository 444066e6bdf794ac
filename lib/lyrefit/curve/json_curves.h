#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/table_curve.h"

namespace lyrefit {

// Finds the curves of a JSON document that is no ivcurves file: lists of numbers under names that a
// table's header may have, pandas tables (records, columns, split, index), NOMAD archives (V,
// mA/cm2). Conditions are taken from the numbers beside a curve and around it. The curves are in
// generator sign and named by their ids, unique in the document. Errors: no curve in it, or a
// broken one; `path` is for them.
Expected<std::vector<RawCurve>> FindJsonCurves(const nlohmann::json& document,
                                               const std::string& path, const ReadOptions& options);

}  // namespace lyrefit
