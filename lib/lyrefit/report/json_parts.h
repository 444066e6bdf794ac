#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/curve/iv_curve.h"

// What the JSON writers share.
namespace lyrefit {

using Json = nlohmann::ordered_json;

// JSON knows neither NaN nor infinity: null.
inline Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json Numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(Number(value));
  return list;
}

// The text of a report, with an end of line. What is not UTF-8 in it, such as a file's name, is
// replaced.
std::string JsonText(const Json& json, int indent = 2);

// Options that differ from their defaults.
Json OptionsJson(const std::vector<OptionEcho>& options);

// Name, source, conditions and assumptions of a curve.
Json CurveJson(const IvCurve& curve);

}  // namespace lyrefit
