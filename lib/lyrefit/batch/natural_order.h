#pragma once

#include <string_view>

namespace lyrefit {

// Whether `a` comes before `b` where numbers count as such, in any locale: "str2" before "str10".
// Bytes decide elsewhere; of equal numbers the one with fewer zeros in front comes first.
bool NaturalLess(std::string_view a, std::string_view b);

}  // namespace lyrefit
