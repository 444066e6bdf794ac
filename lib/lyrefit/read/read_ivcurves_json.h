#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

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
