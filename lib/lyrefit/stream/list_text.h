#pragma once

#include <string_view>

#include "lyrefit/read/records.h"

namespace lyrefit {

// Parses a list in one field of a table: "0 1 2", "0;1;2", "0|1|2", "0,1,2", "[0, 1, 2]". With a
// separator other than the comma, numbers may have a decimal comma. The values are added to `list`.
void ParseList(std::string_view text, int column, Record* list);

// True if a field is a list of at least two numbers in one of these notations.
bool IsList(std::string_view text);

// Parses pairs in one field: "V*I#0*8.1#1*8.0#" (the head may be missing or be I*V), "0:8.1;1:8.0".
// False if there is no pair. The lists are named "V" and "I".
bool ParsePairs(std::string_view text, int column, Records* fields);

}  // namespace lyrefit
