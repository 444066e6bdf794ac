#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/column.h"

namespace lyrefit {

constexpr int kNoColumn = -1;

// How a table is written: what separates the columns, where the rows begin and which column is
// what.
struct TableLayout {
  char delimiter = ',';
  std::size_t first_row_offset = 0;  // where reading the rows begins
  int first_row_line = 0;            // lines before that offset
  std::vector<Column> columns;       // as many as the header has
  int voltage = kNoColumn;
  int current = kNoColumn;
  int sigma = kNoColumn;
  int time = kNoColumn;
  int sweep = kNoColumn;  // a `sweep` or `curve` column
  int irradiance = kNoColumn;
  int temperature = kNoColumn;
  std::vector<std::string> assumptions;
};

// Finds the header among the first lines, behind whatever a tracer writes before it, or decides
// that there is none. `file` is only for the errors.
Expected<TableLayout> FindTableLayout(std::string_view text, const std::string& file);

}  // namespace lyrefit
