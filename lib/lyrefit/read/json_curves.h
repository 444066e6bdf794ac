#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {

// The curves of a JSON document, in its order.
struct JsonCurves {
  std::vector<RawCurve> curves;
  std::vector<RejectedCurve> rejected;  // curves with an invalid reading

  std::size_t size() const { return curves.size() + rejected.size(); }
};

// Finds the curves of a JSON document other than an ivcurves file. It recognises lists of numbers
// under names that a table's header may have, pandas tables (records, columns, split, index) and
// NOMAD archives (V, mA/cm2). Conditions are taken from numbers beside and around a curve. The
// curves are in generator sign and named by ids that are unique in the document. Errors: no curve,
// or no valid one. `path` is only used in errors.
Expected<JsonCurves> FindJsonCurves(const nlohmann::json& document, const std::string& path,
                                    const ReadOptions& options);

}  // namespace lyrefit
