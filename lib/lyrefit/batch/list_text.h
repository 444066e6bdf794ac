#pragma once

#include <string_view>

#include "lyrefit/batch/row_fields.h"

namespace lyrefit {

// A list in one field of a table: "0 1 2", "0;1;2", "0|1|2", "0,1,2", "[0, 1, 2]"; with another
// separator than the comma, numbers may have a decimal comma. Fills the values of `list`.
void ParseList(std::string_view text, int column, RowList* list);

// Whether a field holds two numbers or more so written.
bool IsList(std::string_view text);

// Pairs in one field: "V*I#0*8.1#1*8.0#" (the head may be missing or say I*V), "0:8.1;1:8.0".
// False if it holds none. The lists are called "V" and "I".
bool ParsePairs(std::string_view text, int column, RowFields* fields);

}  // namespace lyrefit
