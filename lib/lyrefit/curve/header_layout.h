#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/table_header.h"
#include "lyrefit/curve/table_layout.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {

// Where a header or first row stands, for the errors.
struct HeaderPlace {
  const std::string& file;
  int line;
  std::string_view text;
  char delimiter;

  tl::unexpected<Error> Refuse(std::string message, int column) const {
    return Fail(std::move(message), file, line, FieldColumn(text, delimiter, column));
  }
};

// What the columns of a header are; where the rows begin is left open. `next_line` is the first
// row.
Expected<TableLayout> LayoutOfHeader(const TableLine& header, const HeaderPlace& place,
                                     std::string_view next_line, const ReadOptions& options);

// The same for a table that begins with a row.
Expected<TableLayout> LayoutWithoutHeader(const TableLine& row, const HeaderPlace& place,
                                          const ReadOptions& options);

// Whether the rows are asked for this column.
bool IsUsed(const TableLayout& layout, int column);

// "'a', 'b'", of many names the first ones.
std::string ListOf(const Fields& names);

}  // namespace lyrefit
