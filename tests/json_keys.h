#pragma once

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

}  // namespace lyrefit
