#pragma once

#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/read/records.h"

namespace lyrefit {

// Parses a JSON object of scalars and lists of scalars on one line, as in JSON Lines, in one pass.
// NaN and Infinity, which Python writes, are missing readings. Deeper nesting is skipped and
// marked. Errors: a sentence and the column; the caller adds file and line.
Expected<void> ParseJsonRow(std::string_view text, Records* fields);

// Reads only the scalars, up to the first syntax error. This suffices for the id of a broken row.
void ScanJsonScalars(std::string_view text, Records* fields);

// Position after the value that begins at `at`; the end of the text if the value is incomplete.
std::size_t SkipJsonValue(std::string_view text, std::size_t at);

}  // namespace lyrefit
