#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
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

// A curve of an ivcurves file, or the reason why it could not be read.
struct IvCurvesEntry {
  std::string id;  // the Index; the place in the file if the Index is no number
  Expected<IvCurve> curve;
};

// Whether a JSON document is an ivcurves file, by its key "IV Curves".
bool IsIvCurves(const nlohmann::json& document);

// All entries of an ivcurves file, including invalid ones. Error: an Index that occurs twice.
// `path` is only used in errors and names.
Expected<std::vector<IvCurvesEntry>> ReadIvCurvesEntries(const nlohmann::json& document,
                                                         const std::string& path);

}  // namespace lyrefit
