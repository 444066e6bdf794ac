#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit {

// A curve of an ivcurves file, or why it could not be read.
struct IvCurvesEntry {
  std::string id;  // its Index; its place in the file where that is not a number
  Expected<IvCurve> curve;
};

// Whether a JSON document is an ivcurves file, by its key "IV Curves".
bool IsIvCurves(const nlohmann::json& document);

// What ReadIvCurvesJson reads, with the broken entries. Two of the same Index are an error.
Expected<std::vector<IvCurvesEntry>> ReadIvCurvesEntries(const nlohmann::json& document,
                                                         const std::string& path);

// A file as JSON.
Expected<nlohmann::json> ReadJsonFile(const std::string& path, const ReadOptions& options);

}  // namespace lyrefit
