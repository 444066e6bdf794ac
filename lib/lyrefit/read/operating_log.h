#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lyrefit {

// A sentence if a table holds the operating points of a day, a row at a time, and no sweep
// (curve_kind.h): a column of dates with times of day, also as two columns, beside one whose name or
// unit says voltage. nullopt: it may hold a sweep, or anything else.
std::optional<std::string> FindOperatingLog(std::string_view text);

}  // namespace lyrefit
