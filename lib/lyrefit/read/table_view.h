#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_layout.h"

namespace lyrefit {

// A table as it stands in a text, also where its header is not understood: the names of its columns
// and its rows, without any meaning.
struct TableView {
  char delimiter = 0;        // 0: the text holds no table
  int header_line = 0;       // 0: no line names the columns
  int first_row_line = 0;    // of the rows
  int count = 0;             // of the rows
  Fields names;              // a name for each column; empty without a header
  std::vector<Fields> rows;  // at most kMostViewedRows
};

constexpr int kMostViewedRows = 20000;

// The largest block of lines that one delimiter splits into equally many fields, with numbers in the
// same columns, and the line of names above it.
TableView ViewTable(std::string_view text);

// The same of a table whose header was understood.
TableView ViewTable(std::string_view text, const TableLayout& layout);

// The numbers of a column, NaN where there is none.
std::vector<double> NumbersOf(const TableView& view, std::size_t column);

// A table of a text as it stands, the layout that the reader finds in it, and its columns.
struct ListedTable {
  TableView view;                // without a delimiter: there is no table
  Expected<TableLayout> layout;  // or why the reader finds none
  std::vector<ColumnNote> columns = {};
};

ListedTable ListTable(std::string_view text, const std::string& file, const ReadOptions& options);

// A sentence if a table holds the operating points of a day, a row at a time, and no sweep
// (curve_kind.h): a column of dates with times of day, also as two columns, beside one whose name or
// unit says voltage. nullopt: it may hold a sweep, or anything else.
std::optional<std::string> FindOperatingLog(std::string_view text);

}  // namespace lyrefit
