#include "lyrefit/read/table_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/text_encoding.h"

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

namespace {

std::string NameOf(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::kVoltage:
      return "voltage";
    case ColumnKind::kCurrent:
      return "current";
    case ColumnKind::kCurrentDensity:
      return "current density";
    case ColumnKind::kSigma:
      return "standard deviation of the current";
    case ColumnKind::kTime:
      return "time";
    case ColumnKind::kSweep:
    case ColumnKind::kCurve:
      return "number of the sweep or curve";
    case ColumnKind::kIrradiance:
      return "irradiance";
    case ColumnKind::kTemperature:
      return "cell temperature";
    default:
      return "not understood";
  }
}

// What a column of a channel is: "voltage", "current 2, sweep 1". Empty: it is of none.
std::string UseInChannel(const TableLayout& layout, int column) {
  const bool several = layout.channels.size() > 1;
  const bool shared = several && layout.channels[0].voltage == layout.channels[1].voltage;
  for (std::size_t k = 0; k < layout.channels.size(); ++k) {
    const Channel& channel = layout.channels[k];
    std::vector<ColumnPair> sweeps = {channel};
    sweeps.insert(sweeps.end(), channel.more.begin(), channel.more.end());
    for (std::size_t n = 0; n < sweeps.size(); ++n) {
      std::string which = several ? fmt::format(" {}", k + 1) : "";
      if (sweeps[n].voltage == column) return "voltage" + (shared ? "" : which);
      if (sweeps.size() > 1) which += fmt::format(", sweep {}", n + 1);
      if (sweeps[n].current == column) {
        return (layout.per_area() ? "current density" : "current") + which;
      }
    }
  }
  return "";
}

std::string UseOf(const TableLayout& layout, int column) {
  std::string use = UseInChannel(layout, column);
  if (!use.empty()) return use;
  if (column == layout.device_column) {
    return fmt::format("device, one of {}", layout.devices.size());
  }
  return IsUsed(layout, column) ? NameOf(layout.columns[column].kind) : "not used";
}

// The unit of a column as it is written: the reader keeps its letters and digits in lower case.
std::string WrittenUnit(const Column& column) {
  if (column.unit.empty()) return "";
  constexpr std::pair<std::string_view, std::string_view> kWritten[] = {
      {"macm2", "mA/cm2"}, {"acm2", "A/cm2"}, {"am2", "A/m2"},   {"wm2", "W/m2"},
      {"mwcm2", "mW/cm2"}, {"kwm2", "kW/m2"}, {"degc", "deg C"}, {"celsius", "deg C"}};
  for (const auto& [unit, written] : kWritten) {
    if (column.unit == unit) return std::string(written);
  }
  std::string unit = column.unit;
  const char last = unit.back();
  const bool symbol =
      unit.size() <= 2 && (last == 'v' || last == 'a' || last == 'c' || last == 'k');
  if (symbol) unit.back() = static_cast<char>(last - 'a' + 'A');
  return unit;
}

void TakeValues(const TableView& view, std::size_t column, ColumnNote* note) {
  constexpr std::size_t kShown = 3;
  for (const Fields& row : view.rows) {
    if (note->first.size() < kShown) note->first.push_back(row[column]);
  }
  for (const double number : NumbersOf(view, column)) {
    if (!(std::abs(number) < kOverflowCode)) continue;
    note->least = note->numbers == 0 ? number : std::min(note->least, number);
    note->largest = note->numbers == 0 ? number : std::max(note->largest, number);
    ++note->numbers;
  }
}

}  // namespace

ListedTable ListTable(std::string_view text, const std::string& file, const ReadOptions& options) {
  ReadOptions any = options;
  if (any.column.empty()) any.column = "1";
  ListedTable listed{{}, FindTableLayout(text, file, any)};
  const Expected<TableLayout>& layout = listed.layout;
  if (layout) listed.view = ViewTable(text, *layout);
  // A header without rows of its kind was split at the wrong places.
  const bool understood = layout && listed.view.count > 0;
  if (!understood) listed.view = ViewTable(text);
  for (std::size_t i = 0; i < listed.view.names.size(); ++i) {
    const std::string& name = listed.view.names[i];
    const Column column = understood ? layout->columns[i] : RecogniseColumn(name);
    ColumnNote note;
    note.place = static_cast<int>(i) + 1;
    note.name = name;
    note.unit = WrittenUnit(column);
    TakeValues(listed.view, i, &note);
    note.use = understood ? UseOf(*layout, static_cast<int>(i)) : NameOf(column.kind);
    if (!understood && column.kind != ColumnKind::kUnrecognised) note.use += " by its name";
    listed.columns.push_back(std::move(note));
  }
  return listed;
}

Expected<std::vector<ColumnNote>> ListColumns(const std::string& path, const ReadOptions& options) {
  namespace fs = std::filesystem;
  const fs::path inside = IsFolder(path) ? CurveInFolder(path) : fs::path(path);
  if (inside.empty()) return Fail("expected a file, found a folder", path);
  TRY(const DecodedText text, ReadDecodedFile(inside.string(), options.largest_file_bytes));
  ListedTable listed = ListTable(RewriteTable(text).text, inside.string(), options);
  if (listed.view.delimiter == 0 && !listed.layout) return tl::unexpected(listed.layout.error());
  return std::move(listed.columns);
}

namespace {

// The times of the rows, of one column or of a date and the time of day right of it; empty if a row
// has none.
std::vector<double> TimesIn(const TableView& view, std::size_t column) {
  std::vector<double> times;
  for (const Fields& row : view.rows) {
    auto time = ReadDateTime(row[column]);
    if (time && std::fmod(*time, kDay_s) == 0 && column + 1 < row.size()) {
      if (const auto joined = ReadDateTime(row[column] + " " + row[column + 1])) time = joined;
    }
    if (!time) return {};
    times.push_back(*time);
  }
  return times;
}

// Whether a name is that of a voltage, or begins as the symbol of one: "Vpv1(V)", "U_dc".
bool NamesVoltage(const std::string& name) {
  if (RecogniseColumn(name).kind == ColumnKind::kVoltage) return true;
  const std::vector<LabelWord> words = SplitLabel(name);
  if (words.empty()) return false;
  const char letter = words.front().text.front();
  const bool marked = words.size() > 1 && words.back().marked_as_unit;
  if (marked) return FindUnit(ColumnKind::kVoltage, words.back().text) != nullptr;
  return letter == 'v' || letter == 'u';
}

// Whether every row has a time of its own, as points have; the readings of a sweep often share one.
bool AreOneATime(std::vector<double> times) {
  constexpr double kMost = 0.9;
  const auto all = static_cast<double>(times.size());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return static_cast<double>(times.size()) >= kMost * all;
}

}  // namespace

std::optional<std::string> FindOperatingLog(std::string_view text) {
  constexpr std::size_t kBeginning = 1 << 14;
  if (text.substr(0, kBeginning).find(':') == std::string_view::npos) return std::nullopt;
  const TableView view = ViewTable(text);
  for (std::size_t column = 0; column < view.names.size(); ++column) {
    const std::vector<double> times = TimesIn(view, column);
    if (times.empty() || !AreOneATime(times)) continue;
    for (std::size_t other = 0; other < view.names.size(); ++other) {
      if (other == column || !NamesVoltage(view.names[other])) continue;
      std::vector<double> kept_times, voltages;
      const std::vector<double> all = NumbersOf(view, other);
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!std::isfinite(all[i])) continue;
        kept_times.push_back(times[i]);
        voltages.push_back(all[i]);
      }
      if (OperatingPointsOfADay(kept_times, voltages)) return OperatingPointsWords(kept_times);
    }
  }
  return std::nullopt;
}

}  // namespace lyrefit
