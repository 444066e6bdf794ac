#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/column.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/table_columns.h"
#include "lyrefit/curve/table_head.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {

constexpr int kNoColumn = -1;

// How a table is written: what separates the columns, where the rows begin and which column is
// what.
struct TableLayout {
  char delimiter = ',';
  std::size_t first_row_offset = 0;  // where reading the rows begins
  int first_row_line = 0;            // lines before that offset
  std::vector<Column> columns;       // as many as the header has
  std::vector<Channel> channels;     // pairs of voltage and current; one of them is read
  int voltage = kNoColumn;
  int current = kNoColumn;
  int sigma = kNoColumn;
  int time = kNoColumn;
  int sweep = kNoColumn;  // a `sweep` or `curve` column
  int irradiance = kNoColumn;
  int temperature = kNoColumn;
  TableHead head;  // what the lines before the header state
  std::vector<Assumption> assumptions;

  bool per_area() const { return columns[current].kind == ColumnKind::kCurrentDensity; }
};

// Finds the header among the first lines, behind whatever a tracer writes before it, or decides
// that there is none. `file` is only for the errors.
Expected<TableLayout> FindTableLayout(std::string_view text, const std::string& file,
                                      const ReadOptions& options = {});

// The same for text between tables, read by `lines` from there on: a header with numbers below it,
// and no numbers before it.
Expected<TableLayout> FindNextLayout(LineReader lines, const std::string& file,
                                     const ReadOptions& options);

// The columns of a table and what each would be read as.
Expected<std::vector<ColumnNote>> ListTableColumns(std::string_view text, const std::string& file,
                                                   const ReadOptions& options);

}  // namespace lyrefit
