#pragma once

#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/row_fields.h"

namespace lyrefit {

// A JSON object of scalars and lists of scalars on one line, as JSON Lines have it, in one pass.
// NaN and Infinity, which Python writes, are missing readings. What is nested deeper is passed over
// and marked. Errors: a sentence and the column, for the caller to say the file and line.
Expected<void> ParseJsonRow(std::string_view text, RowFields* fields);

// The scalars alone, as far as the text can be read: enough for the id of a broken row.
void ScanJsonScalars(std::string_view text, RowFields* fields);

// Where the value that begins at `at` ends, whatever it is; the end of the text if it does not.
std::size_t SkipJsonValue(std::string_view text, std::size_t at);

}  // namespace lyrefit
