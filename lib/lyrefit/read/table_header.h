#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {

using Fields = std::vector<std::string>;

constexpr char kDelimiters[] = {'\t', ';', ',', '|', ' '};  // in the order of trial

// One line of a table, split at the best-fitting delimiter.
struct TableLine {
  char delimiter = 0;  // 0: none fits
  Fields fields;
  std::vector<Column> columns;  // of a header
  bool fits = false;            // the next line has numbers for voltage and current
};

// Fields of a line, without the empty ones of trailing delimiters; nullopt if quotes do not close.
std::optional<Fields> SplitFields(std::string_view line, char delimiter);

std::vector<Column> RecogniseAll(const Fields& fields);

bool HasKind(const std::vector<Column>& columns, ColumnKind kind);

// Rules for the recognition of a header.
struct HeaderRules {
  const ReadOptions& options;                // names of columns
  bool guess = false;                        // use letters and units of unknown names
  std::vector<std::string_view> below = {};  // the first lines below the header
  bool x_is_voltage = false;                 // the head says so of the column X_Value
};

// Interprets `line` as a header with at least a voltage and a current. `next_line` helps to select
// the delimiter, and supplies units that stand in separate columns ("Reading,Unit"). A delimiter at
// which all lines of `rules.below` are rows excludes those at which they are none. The delimiter is 0
// if `line` is no header.
TableLine AsHeader(std::string_view line, std::string_view next_line, const HeaderRules& rules);

// Joins a line of names with a line of units below it: "V [mV],I [mA]". Both must have equally many
// fields. No unit field may be a number, and some must be known units. Empty otherwise.
std::string WithUnits(std::string_view names, std::string_view units);

// Interprets `line` as a row that begins with two numbers.
TableLine AsRow(std::string_view line);

// Records a column name given on a separate line: "Label1: Voltage [V]" or "Column 2 = Current
// (A)". Names are numbered from 1; another first name starts a new list.
void TakeColumnName(std::string_view line, Fields* names);

// Interprets recorded names as the header of `row`. The delimiter is 0 if names and fields differ
// in number, or if there is no voltage and current.
TableLine HeaderOfNames(const Fields& names, const TableLine& row, const HeaderRules& rules);

// Interprets a comment above headerless numbers as a header, "# voltage current", as NumPy writes
// it.
TableLine HeaderInComment(std::string_view comment, std::string_view row, const HeaderRules& rules);

}  // namespace lyrefit
