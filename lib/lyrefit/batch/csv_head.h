#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/batch/row_fields.h"

namespace lyrefit {

// What a table of many curves is.
enum class CsvShape {
  kNone,   // not that of many curves
  kRows,   // one curve a row
  kLong,   // one reading a row
  kNoHead  // one curve a row, and no header
};

// The header of a table of many curves.
struct CsvHead {
  CsvShape shape = CsvShape::kNone;
  char delimiter = ',';
  std::vector<std::string> names;
  std::vector<int> id_columns;  // in the order in which they make the id
  std::int64_t line = 0;        // where it stands
};

// Looks at the first lines of a file: the header, behind blank lines and comments, and some rows.
CsvHead FindCsvHead(std::string_view text, const ReadOptions& options);

// The id of a row, empty where it has none. In one pass over its beginning.
// `looked_at`: how many bytes of it say so, if asked for; a row that begins alike has the same.
std::string IdOfCsvRow(std::string_view row, const CsvHead& head, std::size_t* looked_at = nullptr);

// Takes a row apart. Errors: a sentence and the column.
Expected<void> ParseCsvRow(std::string_view row, const CsvHead& head, const ReadOptions& options,
                           RowFields* fields);

// A field that is no reading; a number with a decimal comma gets a point, where the table may have
// such.
std::string ScalarText(std::string_view text, char delimiter);

// Text in UTF-8; that of Windows is decoded.
std::string AsUtf8(std::string_view text);

}  // namespace lyrefit
