#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/base/error.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {

// Position of a header or first row, for errors.
struct HeaderPlace {
  const std::string& file;
  int line;
  std::string_view text;
  char delimiter;

  tl::unexpected<Error> Refuse(std::string message, int column) const {
    return Fail(std::move(message), file, line, FieldColumn(text, delimiter, column));
  }
};

// Interprets the columns of a header. `next_line` is the line below it. The caller sets where the
// rows begin.
Expected<TableLayout> LayoutOfHeader(const TableLine& header, const HeaderPlace& place,
                                     std::string_view next_line, const ReadOptions& options);

// Builds the layout of a table without a header from its first row.
Expected<TableLayout> LayoutWithoutHeader(const TableLine& row, const HeaderPlace& place,
                                          const ReadOptions& options);

// Adds the sentence on the columns that are not used.
void SayWhatIsNotUsed(TableLayout* layout);

// Whether values of this column are read.
bool IsUsed(const TableLayout& layout, int column);

// The names as "'a', 'b'"; of many names only the first ones.
std::string ListOf(const Fields& names);

}  // namespace lyrefit
