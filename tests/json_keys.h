#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace lyrefit {

inline std::set<std::string> Keys(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

// Removes the times, which alone differ between two identical runs.
inline void RemoveSeconds(nlohmann::json* value) {
  if (value->is_object()) value->erase("seconds");
  for (auto& child : *value) {
    if (child.is_structured()) RemoveSeconds(&child);
  }
}

// The values of a JSON document, a line each: where it stands and what it is. Of a list of more than
// eight plain values their number and the first, of a list of objects the first three. Without
// `values` only the kinds: for documents whose numbers are computed.
inline std::string Outline(const nlohmann::json& value, bool values = true,
                           const std::string& at = "") {
  std::string lines;
  const auto text_of = [values](const nlohmann::json& one) -> std::string {
    if (!values && !one.is_null() && !one.is_boolean()) return one.type_name();
    if (!one.is_number_float()) return one.dump();
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", one.get<double>());
    return text;
  };
  const auto line = [&](const std::string& what) { lines = at + ": " + what + "\n"; };
  if (value.is_object() && !value.empty()) {
    for (const auto& [key, child] : value.items()) {
      lines += Outline(child, values, at.empty() ? key : at + "." + key);
    }
  } else if (value.is_array() && !value.empty() && value.front().is_structured()) {
    line(values ? std::to_string(value.size()) + " entries" : "entries");
    for (std::size_t k = 0; k < value.size() && k < (values ? 3U : 1U); ++k) {
      lines += Outline(value[k], values, at + "[" + std::to_string(k) + "]");
    }
  } else if (value.is_array() && value.size() > 8) {
    line(std::to_string(value.size()) + " values from " + text_of(value.front()));
  } else {
    line(text_of(value));
  }
  return lines;
}

}  // namespace lyrefit
