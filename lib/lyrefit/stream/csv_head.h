#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/records.h"

namespace lyrefit {

// Shape of a table of many curves.
enum class CsvShape {
  kNone,   // not a table of many curves
  kRows,   // one curve a row
  kLong,   // one reading a row
  kNoHead  // one curve a row, without a header
};

// The header of a table of many curves.
struct CsvHead {
  CsvShape shape = CsvShape::kNone;
  char delimiter = ',';
  std::vector<std::string> names;
  std::vector<bool> readings;   // columns of voltages and currents, also by other names
  std::vector<int> id_columns;  // in the order of the parts of the id
  int time_column = -1;         // the last part of the id, where the others repeat; -1: none
  std::int64_t line = 0;        // its line in the file
};

// Detects header and shape from the first lines of a file. The header follows blank lines and
// comments.
CsvHead FindCsvHead(std::string_view text, const ReadOptions& options);

// The id of a row; empty if there is none. Only the beginning of the row is parsed. `looked_at`, if
// not null, receives the number of bytes that determine the id. A row with the same first bytes has
// the same id.
std::string IdOfCsvRow(std::string_view row, const CsvHead& head, std::size_t* looked_at = nullptr);

// Parses a row. Errors: a sentence and the column.
Expected<void> ParseCsvRow(std::string_view row, const CsvHead& head, Records* fields);

// A field that is not a reading. A decimal comma becomes a point if the delimiter allows decimal
// commas.
std::string ScalarText(std::string_view text, char delimiter);

// `text` in UTF-8; Windows-1252 is decoded.
std::string AsUtf8(std::string_view text);

}  // namespace lyrefit
