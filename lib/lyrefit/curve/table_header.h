#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/curve/column.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit {

using Fields = std::vector<std::string>;

constexpr char kDelimiters[] = {'\t', ';', ',', ' '};  // in the order they are tried

// One line of a table under the one delimiter that makes most of it.
struct TableLine {
  char delimiter = 0;  // 0: none fits
  Fields fields;
  std::vector<Column> columns;  // of a header
  bool fits = false;            // the line below a header has numbers where it promises them
};

// The fields without the empty ones that trailing delimiters leave; nothing if quotes do not close.
std::optional<Fields> SplitFields(std::string_view line, char delimiter);

std::vector<Column> RecogniseAll(const Fields& fields);

bool HasKind(const std::vector<Column>& columns, ColumnKind kind);

// How a header is recognised.
struct HeaderRules {
  const ReadOptions& options;  // names of columns
  bool guess = false;          // letters and units count where names are unknown
};

// `line` as a header of at least a voltage and a current; `next_line` helps to choose the
// delimiter, and says the units where they stand in columns of their own ("Reading,Unit").
TableLine AsHeader(std::string_view line, std::string_view next_line, const HeaderRules& rules);

// The line of names with the units that `units` has below them, "V [mV],I [mA]": as many fields,
// none a number, some known units. Empty if `units` is no such line.
std::string WithUnits(std::string_view names, std::string_view units);

// `line` as a row that begins with two numbers.
TableLine AsRow(std::string_view line);

// Remembers the name of a column that a line of its own gives, "Label1: Voltage [V]" or "Column 2 =
// Current (A)"; they are numbered from 1, another first one begins anew.
void TakeColumnName(std::string_view line, Fields* names);

// The names so given as the header of `row`; without a delimiter if they are not as many as the row
// has fields, or no voltage and current.
TableLine HeaderOfNames(const Fields& names, const TableLine& row, const HeaderRules& rules);

// "# voltage current" above headerless numbers, as NumPy writes it.
TableLine HeaderInComment(std::string_view comment, std::string_view row, const HeaderRules& rules);

}  // namespace lyrefit
