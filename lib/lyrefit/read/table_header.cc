#include "lyrefit/read/table_header.h"

#include <algorithm>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/column_names.h"
#include "lyrefit/read/guess_columns.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostColumns = 5000;  // a longer line is no header

// Joins brackets to the name before them: with blanks as delimiter, "Voltage (V)" would be two
// fields.
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

bool IsNumber(const std::string& field, char delimiter) {
  return ParseNumber(field, delimiter != ',').has_value();
}

bool IsNumericRow(const Fields& fields, char delimiter) {
  return fields.size() >= 2 && IsNumber(fields[0], delimiter) && IsNumber(fields[1], delimiter);
}

// Interprets unit columns: a column "... Unit" that holds "Amp DC" determines the kind of the
// column on its left.
void TakeUnitColumns(const Fields& names, const Fields& row, std::vector<Column>* columns) {
  for (std::size_t i = 1; i < names.size() && i < row.size(); ++i) {
    const std::vector<LabelWord> words = SplitLabel(names[i]);
    if (words.empty() || words.back().text != "unit") continue;
    Column said = RecogniseColumn(row[i]);
    if (said.kind != ColumnKind::kVoltage && said.kind != ColumnKind::kCurrent) continue;
    if (said.unit.empty()) continue;
    said.label = names[i - 1];
    (*columns)[i - 1] = said;
  }
}

// Takes a first column without a name, beside nothing but currents, as their voltage, unless it
// counts the rows.
void TakeUnnamedVoltage(const std::vector<std::string_view>& below, char delimiter,
                        std::vector<Column>* columns) {
  const bool only_currents = std::all_of(columns->begin() + 1, columns->end(), [](const Column& c) {
    return IsCurrent(c.kind) && c.refusal.empty();
  });
  if (!columns->front().label.empty() || !only_currents || below.size() < 2) return;
  bool counts = true;
  std::optional<double> last;
  for (const std::string_view line : below) {
    const auto row = SplitFields(line, delimiter);
    const auto number =
        row && !row->empty() ? ParseNumber((*row)[0], delimiter != ',') : std::optional<double>();
    if (!number) return;
    counts = counts && (last ? *number == *last + 1 : *number == 0 || *number == 1);
    last = number;
  }
  if (!counts) columns->front().kind = ColumnKind::kVoltage;
}

std::vector<Column> ColumnsOf(const Fields& fields, std::string_view next_line, char delimiter,
                              const HeaderRules& rules) {
  std::vector<Column> columns = RecogniseAll(fields);
  if (rules.x_is_voltage && columns.size() > 1 && columns[0].label == "X_Value" &&
      !HasKind(columns, ColumnKind::kVoltage)) {
    columns[0].kind = ColumnKind::kVoltage;
  }
  const auto row = SplitFields(next_line, delimiter);
  const bool wished =
      !rules.options.voltage_column.empty() || !rules.options.current_column.empty();
  // An option may give only a place, which any line has. So only a line right above the numbers is
  // then a header.
  const bool above_numbers =
      row && row->size() <= fields.size() && row->size() >= 2 && !IsNumericRow(fields, delimiter);
  if (wished && above_numbers) ApplyColumnWishes(rules.options, &columns);
  if (row && !LooksLikeHeader(columns)) TakeUnitColumns(fields, *row, &columns);
  const bool found = LooksLikeHeader(columns) && !FindChannels(columns).empty();
  if (rules.guess && above_numbers && !found && !GuessColumns(&columns)) {
    TakeUnnamedVoltage(rules.below, delimiter, &columns);
  }
  return columns;
}

// Whether the line below the header has numbers in the header's voltage and current columns.
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

// Whether all lines below are rows of the header at this delimiter.
bool AllRowsFit(std::size_t names, char delimiter, const std::vector<std::string_view>& below) {
  return names >= 2 && !below.empty() &&
         std::all_of(below.begin(), below.end(), [&](std::string_view line) {
           const auto row = SplitFields(line, delimiter);
           return row && row->size() <= names &&
                  std::count_if(row->begin(), row->end(), [&](const std::string& field) {
                    return IsNumber(field, delimiter);
                  }) >= 2;
         });
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

TableLine AsHeader(std::string_view line, std::string_view next_line, const HeaderRules& rules) {
  TableLine first;
  const auto split = [line](char delimiter) {
    auto fields = SplitFields(line, delimiter);
    if (fields && delimiter == ' ') fields = JoinBrackets(*fields);
    return fields;
  };
  const auto fits_rows = [&](char delimiter) {
    const auto fields = split(delimiter);
    return fields && AllRowsFit(fields->size(), delimiter, rules.below);
  };
  const bool any_fits = std::any_of(std::begin(kDelimiters), std::end(kDelimiters), fits_rows);
  for (const char delimiter : kDelimiters) {
    auto fields = split(delimiter);
    if (!fields || fields->size() > kMostColumns) continue;
    if (any_fits && !AllRowsFit(fields->size(), delimiter, rules.below)) continue;
    std::vector<Column> columns = ColumnsOf(*fields, next_line, delimiter, rules);
    if (!LooksLikeHeader(columns)) continue;
    TableLine candidate{delimiter, *fields, columns, false};
    candidate.fits = RowFits(next_line, candidate);
    if (candidate.fits) return candidate;
    if (first.delimiter == 0) first = candidate;
  }
  return first;
}

std::string WithUnits(std::string_view names, std::string_view units) {
  for (const char delimiter : kFieldMarks) {
    const auto above = SplitFields(names, delimiter);
    const auto below = SplitFields(units, delimiter);
    if (!above || !below || above->size() < 2 || above->size() != below->size()) continue;
    std::string joined;
    bool any_unit = false;
    bool any_number = false;
    for (std::size_t i = 0; i < above->size(); ++i) {
      std::string name = (*above)[i];
      std::string unit = (*below)[i];
      any_number = any_number || IsNumber(unit, delimiter);
      const std::vector<LabelWord> words = SplitLabel(TakeScale(unit).label);
      const std::string text = JoinWords(words, 0, words.size());
      for (const ColumnKind kind : {ColumnKind::kVoltage, ColumnKind::kCurrent,
                                    ColumnKind::kCurrentDensity, ColumnKind::kTime}) {
        any_unit = any_unit || FindUnit(kind, text) != nullptr;
      }
      for (std::string* part : {&name, &unit}) {
        part->erase(std::remove(part->begin(), part->end(), '"'), part->end());
      }
      const bool marked = !unit.empty() && (unit[0] == '(' || unit[0] == '[');
      if (!unit.empty()) name += marked ? " " + unit : " [" + unit + "]";
      joined += (i == 0 ? "\"" : std::string(1, delimiter) + "\"") + name + "\"";
    }
    if (any_unit && !any_number) return joined;
  }
  return "";
}

TableLine AsRow(std::string_view line) {
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(line, delimiter);
    if (fields && IsNumericRow(*fields, delimiter)) return {delimiter, *fields, {}, false};
  }
  return {};
}

void TakeColumnName(std::string_view line, Fields* names) {
  const std::size_t mark = line.find_first_of(":=");
  if (mark == std::string_view::npos) return;
  const std::string key = LowerCase(TrimBlanks(line.substr(0, mark)));
  const std::size_t digits = key.find_last_not_of("0123456789") + 1;
  const std::string_view word = TrimBlanks(std::string_view(key).substr(0, digits));
  if (word != "label" && word != "column" && word != "col") return;
  if (key.substr(digits) == "1") names->clear();
  if (key.substr(digits) != std::to_string(names->size() + 1)) return;
  std::string name(TrimBlanks(line.substr(mark + 1)));
  std::replace(name.begin(), name.end(), '\t', ' ');
  names->push_back(std::move(name));
}

TableLine HeaderOfNames(const Fields& names, const TableLine& row, const HeaderRules& rules) {
  if (names.empty() || names.size() != row.fields.size()) return {};
  TableLine header = {row.delimiter, names, RecogniseAll(names), true};
  ApplyColumnWishes(rules.options, &header.columns);
  return FindChannels(header.columns).empty() ? TableLine{} : header;
}

TableLine HeaderInComment(std::string_view comment, std::string_view row,
                          const HeaderRules& rules) {
  const std::size_t text = comment.find_first_not_of("#% \t");
  if (text == std::string_view::npos) return {};
  TableLine candidate = AsHeader(comment.substr(text), row, rules);
  const TableLine numbers = AsRow(row);
  const bool fits = candidate.delimiter != 0 && candidate.fields.size() == numbers.fields.size();
  if (!fits) return {};
  candidate.delimiter = numbers.delimiter;
  return candidate;
}

}  // namespace lyrefit
