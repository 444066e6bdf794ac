#include "lyrefit/curve/table_header.h"

#include <algorithm>

#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {
namespace {

// In a header separated by blanks "Voltage (V)" is one name.
Fields JoinBrackets(const Fields& fields) {
  Fields joined;
  for (const std::string& field : fields) {
    const bool bracket = !field.empty() && (field[0] == '(' || field[0] == '[');
    if (bracket && !joined.empty()) {
      joined.back() += " " + field;
    } else {
      joined.push_back(field);
    }
  }
  return joined;
}

bool LooksLikeHeader(const std::vector<Column>& columns) {
  return HasKind(columns, ColumnKind::kVoltage) &&
         (HasKind(columns, ColumnKind::kCurrent) || HasKind(columns, ColumnKind::kCurrentDensity));
}

bool IsNumericRow(const Fields& fields, char delimiter) {
  return fields.size() >= 2 && ParseNumber(fields[0], delimiter != ',') &&
         ParseNumber(fields[1], delimiter != ',');
}

// True if the line below the header has numbers where the header promises voltage and current.
bool RowFits(std::string_view line, const TableLine& header) {
  const auto row = SplitFields(line, header.delimiter);
  if (!row || row->size() > header.columns.size()) return false;
  for (std::size_t i = 0; i < header.columns.size(); ++i) {
    const ColumnKind kind = header.columns[i].kind;
    if (kind != ColumnKind::kVoltage && kind != ColumnKind::kCurrent) continue;
    if (i >= row->size() || !ParseNumber((*row)[i], header.delimiter != ',')) return false;
  }
  return true;
}

}  // namespace

std::optional<Fields> SplitFields(std::string_view line, char delimiter) {
  LineSplitter splitter(delimiter);
  if (!splitter.Split(line)) return std::nullopt;
  Fields fields;
  for (std::size_t i = 0; i < splitter.size(); ++i) fields.emplace_back(splitter[i]);
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::vector<Column> RecogniseAll(const Fields& fields) {
  std::vector<Column> columns;
  for (const std::string& field : fields) columns.push_back(RecogniseColumn(field));
  return columns;
}

bool HasKind(const std::vector<Column>& columns, ColumnKind kind) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const Column& column) { return column.kind == kind; });
}

TableLine AsHeader(std::string_view line, std::string_view next_line) {
  TableLine first;
  for (const char delimiter : kDelimiters) {
    auto fields = SplitFields(line, delimiter);
    if (!fields) continue;
    if (delimiter == ' ') fields = JoinBrackets(*fields);
    std::vector<Column> columns = RecogniseAll(*fields);
    if (!LooksLikeHeader(columns)) continue;
    TableLine candidate{delimiter, *fields, columns, false};
    candidate.fits = RowFits(next_line, candidate);
    if (candidate.fits) return candidate;
    if (first.delimiter == 0) first = candidate;
  }
  return first;
}

TableLine AsRow(std::string_view line) {
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(line, delimiter);
    if (fields && IsNumericRow(*fields, delimiter)) return {delimiter, *fields, {}, false};
  }
  return {};
}

TableLine HeaderInComment(std::string_view comment, std::string_view row) {
  const std::size_t text = comment.find_first_not_of("# \t");
  if (text == std::string_view::npos) return {};
  TableLine candidate = AsHeader(comment.substr(text), row);
  const TableLine numbers = AsRow(row);
  const bool fits = candidate.delimiter != 0 && candidate.fields.size() == numbers.fields.size();
  if (!fits) return {};
  candidate.delimiter = numbers.delimiter;
  return candidate;
}

}  // namespace lyrefit
