#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/curve/column.h"

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

// `line` as a header of at least a voltage and a current; `next_line` helps to choose the
// delimiter.
TableLine AsHeader(std::string_view line, std::string_view next_line);

// `line` as a row that begins with two numbers.
TableLine AsRow(std::string_view line);

// "# voltage current" above headerless numbers, as NumPy writes it.
TableLine HeaderInComment(std::string_view comment, std::string_view row);

}  // namespace lyrefit
