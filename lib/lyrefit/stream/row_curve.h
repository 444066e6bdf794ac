#pragma once

#include <map>
#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/records.h"
#include "lyrefit/stream/batch_source.h"

namespace lyrefit {

// Parses a JSON object of scalars and lists of scalars on one line, as in JSON Lines, in one pass.
// NaN and Infinity, which Python writes, are missing readings. Deeper nesting is skipped and
// marked. Errors: a sentence and the column; the caller adds file and line.
Expected<void> ParseJsonRow(std::string_view text, Records* fields);

// Reads only the scalars, up to the first syntax error. This suffices for the id of a broken row.
void ScanJsonScalars(std::string_view text, Records* fields);

// Position after the value that begins at `at`; the end of the text if the value is incomplete.
std::size_t SkipJsonValue(std::string_view text, std::size_t at);

// Prefix of the error of a row that was already broken when it was packed.
inline constexpr std::string_view kPackedAsBroken = "packed as a broken one: ";

// The curve of a row. Its lists have the column names of ReadCurve, and its scalars state
// conditions and notes. `id` becomes the curve's name.
Expected<IvCurve> CurveOfRow(const Records& fields, const RecordPlace& place, const std::string& id,
                             const ReadOptions& options);

// The scalars that are neither a condition nor a note nor part of the id.
std::map<std::string, std::string> BesideOfRow(const Records& fields);

}  // namespace lyrefit
