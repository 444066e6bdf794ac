#include "lyrefit/read/table_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

// A text without a table has no end of lines to try: the search for one looks at this many.
constexpr int kMostSearchedLines = 5000;

// Consecutive lines that may be the rows of a table.
struct Block {
  char delimiter = 0;
  std::size_t fields = 0;
  std::size_t numbers = 0;  // columns with a number in every line
  std::vector<bool> numeric = {};
  std::size_t offset = 0;  // of the first line
  int line = 0;            // number of the first line
  int lines = 0;

  double Weight() const { return static_cast<double>(numbers) * lines; }
};

std::vector<bool> NumericFields(const Fields& fields, char delimiter) {
  std::vector<bool> numeric;
  for (const std::string& field : fields) {
    numeric.push_back(ParseNumber(field, delimiter != ',') || IsMissingWord(field));
  }
  return numeric;
}

// The block of greatest weight that a delimiter makes.
Block LargestBlock(std::string_view text, char delimiter) {
  Block best, block;
  const auto close = [&] {
    if (block.Weight() > best.Weight()) best = block;
    block = {};
  };
  LineReader lines(text);
  std::size_t offset = 0;
  for (std::string_view line;
       lines.number() < kMostSearchedLines && lines.NextContent(&line, &offset);) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields || fields->empty()) {
      close();
      continue;
    }
    std::vector<bool> numeric = NumericFields(*fields, delimiter);
    if (block.lines > 0 && fields->size() == block.fields) {
      for (std::size_t i = 0; i < numeric.size(); ++i) numeric[i] = numeric[i] && block.numeric[i];
    } else {
      close();
    }
    const auto count = static_cast<std::size_t>(std::count(numeric.begin(), numeric.end(), true));
    const bool prose = delimiter == ' ' && 2 * count < fields->size();
    if (count == 0 || prose || (block.lines > 0 && 2 * count < block.numbers)) {
      close();  // a line of names, of units or of words, which belongs to no block
      continue;
    }
    if (block.lines == 0) block = {delimiter, fields->size(), count, {}, offset, lines.number(), 0};
    block.numeric = std::move(numeric);
    block.numbers = count;
    ++block.lines;
  }
  close();
  return best;
}

// `fields` at the columns of a table, or none if they are no names of as many columns.
Fields AsNames(std::string_view line, const Block& block) {
  const std::size_t begin = line.find_first_not_of("#% \t");
  const bool comment = begin != std::string_view::npos && line.find_first_of("#%") < begin;
  auto fields = SplitFields(comment ? line.substr(begin) : line, block.delimiter);
  if (!fields || fields->size() != block.fields) return {};
  const std::vector<bool> numeric = NumericFields(*fields, block.delimiter);
  if (std::all_of(numeric.begin(), numeric.end(), [](bool is) { return is; })) return {};
  return std::move(*fields);
}

// Reads the names in the line above the block, or in the line above one of units.
void TakeNames(std::string_view text, const Block& block, TableView* view) {
  LineReader lines(text);
  std::string_view line, last, before;
  int last_number = 0, before_number = 0;
  while (lines.Next(&line) && lines.number() < block.line) {
    if (line.find_first_not_of(" \t,;") == std::string_view::npos) continue;
    before = std::exchange(last, line);
    before_number = std::exchange(last_number, lines.number());
  }
  if (const std::string joined = WithUnits(before, last); !joined.empty()) {
    view->names = AsNames(joined, block);
    view->header_line = before_number;
  }
  if (view->names.empty()) {
    view->names = AsNames(last, block);
    view->header_line = last_number;
  }
  if (view->names.empty()) view->header_line = 0;
}

// Reads rows from `lines` on, up to the first line without a number in any column.
void TakeRows(LineReader lines, std::size_t columns, TableView* view) {
  for (std::string_view line; lines.NextContent(&line);) {
    auto fields = SplitFields(line, view->delimiter);
    if (!fields || fields->size() > columns || fields->empty()) break;
    const std::vector<bool> numeric = NumericFields(*fields, view->delimiter);
    if (std::none_of(numeric.begin(), numeric.end(), [](bool is) { return is; })) break;
    if (view->count++ >= kMostViewedRows) continue;
    fields->resize(columns);
    view->rows.push_back(std::move(*fields));
  }
}

}  // namespace

TableView ViewTable(std::string_view text) {
  Block best;
  for (const char delimiter : kDelimiters) {
    const Block block = LargestBlock(text, delimiter);
    if (block.Weight() > best.Weight()) best = block;
  }
  TableView view;
  view.delimiter = best.delimiter;
  constexpr int kFewestRows = 2;
  if (best.lines < kFewestRows) view.delimiter = 0;
  if (view.delimiter == 0) return view;
  view.first_row_line = best.line;
  TakeNames(text, best, &view);
  TakeRows(LineReader(text, best.offset, best.line - 1), best.fields, &view);
  if (view.names.empty()) view.names.resize(best.fields);
  return view;
}

TableView ViewTable(std::string_view text, const TableLayout& layout) {
  TableView view;
  view.delimiter = layout.delimiter;
  view.first_row_line = layout.first_row_line + 1;
  for (const Column& column : layout.columns) view.names.push_back(column.label);
  const bool named = std::any_of(view.names.begin(), view.names.end(),
                                 [](const std::string& name) { return !name.empty(); });
  if (named) view.header_line = layout.first_row_line;
  TakeRows(LineReader(text, layout.first_row_offset, layout.first_row_line), view.names.size(),
           &view);
  return view;
}

std::vector<double> NumbersOf(const TableView& view, std::size_t column) {
  std::vector<double> numbers;
  for (const Fields& row : view.rows) {
    numbers.push_back(ParseNumber(row[column], view.delimiter != ',').value_or(kUnknown));
  }
  return numbers;
}

}  // namespace lyrefit
