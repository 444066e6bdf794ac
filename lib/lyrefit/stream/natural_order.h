#pragma once

#include <string_view>

namespace lyrefit {

// Natural order, independent of the locale: digits are compared as numbers, "str2" before "str10".
// Other bytes are compared by value. Of equal numbers the one with fewer leading zeros comes first.
bool NaturalLess(std::string_view a, std::string_view b);

}  // namespace lyrefit
