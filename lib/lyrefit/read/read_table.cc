#include "lyrefit/read/read_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/stoppable_reads.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/number_text.h"
#include "lyrefit/read/suns_voc.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/table_row.h"

namespace lyrefit {
namespace {

// A column that is read, and the destination of its values.
struct Slot {
  int field;
  std::vector<double>* values;
};

class RowReader {
 public:
  RowReader(const TableLayout& layout, const std::string& file, bool skip_missing, Table* table)
      : layout_(layout),
        row_(layout.columns, layout.delimiter, file),
        skip_missing_(skip_missing),
        table_(table) {
    IvCurve* curve = &table->curve;
    slots_ = {{layout.voltage, &curve->voltage_V}, {layout.current, &curve->current_A}};
    if (layout.sigma != kNoColumn) slots_.push_back({layout.sigma, &curve->sigma_A});
    if (layout.time != kNoColumn) slots_.push_back({layout.time, &curve->time_s});
    if (layout.irradiance != kNoColumn) {
      slots_.push_back({layout.irradiance, &curve->irradiance_W_m2});
    }
    if (layout.temperature != kNoColumn) {
      slots_.push_back({layout.temperature, &curve->temperature_C});
    }
    values_.resize(slots_.size());
    further_.resize(layout.more.size());
  }

  // Appends the row completely or not at all. A row with a missing reading may be skipped.
  Expected<void> Read(std::string_view line, int number) {
    const ColumnPair first = {layout_.voltage, layout_.current};
    const bool side_by_side = layout_.channels.size() > 1 || !layout_.more.empty();
    const bool ended = side_by_side && IsPastEnd(line, first);
    if (ended && layout_.more.empty()) return {};
    TRY(row_.Take(line, number));
    for (std::size_t i = 0; i < further_.size(); ++i) {
      TRY(ReadFurther(line, number, layout_.more[i], &further_[i]));
    }
    if (ended) return {};
    if (skip_missing_ && IsMissing(first)) {
      table_->skipped.push_back(number);
      return {};
    }
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      TRY(const double value, row_.Value(slots_[i].field));
      values_[i] = value;
    }
    if (layout_.sweep != kNoColumn) {
      TRY(const int sweep, row_.WholeNumber(layout_.sweep));
      table_->curve.sweep.push_back(sweep);
    }
    for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i].values->push_back(values_[i]);
    table_->lines.push_back(number);
    return {};
  }

  // The further sweeps of the measurement.
  std::vector<FurtherSweep> TakeFurther() { return std::move(further_); }

  // Records the error of a row that Read refused. False if the row's sweep cannot be read.
  bool SetAside(std::string_view line, int number, const Error& error) {
    if (layout_.sweep == kNoColumn || !row_.Take(line, number)) return false;
    const Expected<int> sweep = row_.WholeNumber(layout_.sweep);
    if (sweep) table_->broken.try_emplace(*sweep, error);
    return sweep.has_value();
  }

 private:
  bool IsMissing(const ColumnPair& pair) const {
    const bool comma = layout_.delimiter != ',';
    return IsMissingReading(row_[pair.voltage], comma) ||
           IsMissingReading(row_[pair.current], comma);
  }

  // Whether a pair has ended: of pairs side by side, some may be shorter than others.
  bool IsPastEnd(std::string_view line, const ColumnPair& pair) const {
    const auto fields = SplitFields(line, layout_.delimiter);
    if (!fields) return false;
    const auto empty = [&](int field) {
      return field >= static_cast<int>(fields->size()) || (*fields)[field].empty();
    };
    return empty(pair.voltage) && empty(pair.current);
  }

  Expected<void> ReadFurther(std::string_view line, int number, const ColumnPair& pair,
                             FurtherSweep* sweep) {
    if (IsPastEnd(line, pair)) return {};
    if (skip_missing_ && IsMissing(pair)) {
      if (table_->skipped.empty() || table_->skipped.back() != number) {
        table_->skipped.push_back(number);
      }
      return {};
    }
    const std::pair<int, std::vector<double>*> targets[] = {
        {pair.voltage, &sweep->curve.voltage_V},
        {pair.current, &sweep->curve.current_A},
        {layout_.sigma, &sweep->curve.sigma_A},
        {layout_.irradiance, &sweep->curve.irradiance_W_m2},
        {layout_.temperature, &sweep->curve.temperature_C}};
    for (const auto& [field, values] : targets) {
      if (field == kNoColumn) continue;
      TRY(const double value, row_.Value(field));
      values->push_back(value);
    }
    sweep->lines.push_back(number);
    return {};
  }

  const TableLayout& layout_;
  TableRow row_;
  const bool skip_missing_;
  Table* table_;
  std::vector<Slot> slots_;
  std::vector<double> values_;
  std::vector<FurtherSweep> further_;
};

bool HasLetter(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           static_cast<unsigned char>(c) >= 0x80;
  });
}

// Whether `line` cannot be a row of the table, not even an invalid one. Such a line begins with a
// word in place of a number, or has no number in the voltage column. A line of delimiters only
// counts as text.
bool IsText(std::string_view line, const TableLayout& layout) {
  const auto fields = SplitFields(line, layout.delimiter);
  if (!fields) return false;
  if (fields->empty()) return true;
  const bool decimal_comma = layout.delimiter != ',';
  const std::string& first = fields->front();
  if (ParseNumber(first, decimal_comma) || IsMissingWord(first) || !HasLetter(first)) return false;
  if (layout.voltage == 0 || layout.current == 0) return true;
  const std::size_t voltage = layout.voltage;
  return voltage >= fields->size() || !ParseNumber((*fields)[voltage], decimal_comma);
}

// State while a table and the tables below it are read.
struct TablesBelow {
  std::string_view text;
  const std::string& file;
  const ReadOptions& options;
  BrokenRows broken_rows;
  Table table;
  std::vector<std::size_t> starts;  // first rows of the second and later tables
  std::vector<Sidecar> heads;
};

// Whether the lines up to line `before` (0: the end) contain no row of the table.
bool OnlyText(LineReader lines, int before, const TableLayout& layout) {
  for (std::string_view line; lines.NextContent(&line);) {
    if (before != 0 && lines.number() >= before) return true;
    if (!IsText(line, layout)) return false;
  }
  return true;
}

void SayWhatWasLeft(Table* table, LineReader lines) {
  constexpr int kShown = 3;
  int count = 0;
  std::string shown;
  int first = 0;
  for (std::string_view line; lines.NextContent(&line);) {
    if (line.find_first_not_of(" \t,;") == std::string_view::npos) continue;
    if (count++ == 0) first = lines.number();
    if (count <= kShown) shown += (count == 1 ? "" : ", ") + Quoted(line);
  }
  if (count == 0) return;
  table->curve.assumptions.push_back(
      fmt::format("{} line{} of text below the table left aside, from line {} on: {}{}", count,
                  count == 1 ? "" : "s", first, shown, count > kShown ? ", ..." : ""));
}

// Reads rows up to the end of the text or the next table.
Expected<std::optional<TableLayout>> ReadRows(TablesBelow* rows, const TableLayout& layout) {
  RowReader reader(layout, rows->file, rows->options.skip_missing, &rows->table);
  LineReader lines(rows->text, layout.first_row_offset, layout.first_row_line);
  std::size_t offset = lines.offset();
  for (std::string_view line; lines.NextContent(&line, &offset);) {
    if (line.find_first_not_of(" \t,;") == std::string_view::npos) continue;
    if (StoppableReads::Stopped()) return FailAsStopped(rows->file);
    const auto read = reader.Read(line, lines.number());
    if (read) continue;
    const bool aside = rows->broken_rows == BrokenRows::kSetAside &&
                       reader.SetAside(line, lines.number(), read.error());
    if (aside) continue;
    lines.StepBack(offset);
    JoinSweeps(layout.columns, layout.channel(), reader.TakeFurther(), &rows->table.curve,
               &rows->table.lines);
    const Expected<TableLayout> next = FindNextLayout(lines, rows->file, rows->options);
    if (next && OnlyText(lines, next->first_row_line, layout)) {
      return std::optional<TableLayout>(*next);
    }
    const bool last = rows->table.curve.size() > 0 && OnlyText(lines, 0, layout);
    if (!last) return tl::unexpected(read.error());
    SayWhatWasLeft(&rows->table, lines);
    return std::optional<TableLayout>();
  }
  JoinSweeps(layout.columns, layout.channel(), reader.TakeFurther(), &rows->table.curve,
             &rows->table.lines);
  return std::optional<TableLayout>();
}

void SayWhatWasSkipped(Table* table) {
  constexpr std::size_t kShown = 10;
  const std::vector<int>& skipped = table->skipped;
  if (skipped.empty()) return;
  std::string shown;
  for (std::size_t i = 0; i < skipped.size() && i < kShown; ++i) {
    shown += fmt::format("{}{}", i == 0 ? "" : ", ", skipped[i]);
  }
  table->curve.assumptions.push_back(
      fmt::format("{} of {} rows without a reading left out: line{} {}{}", skipped.size(),
                  skipped.size() + table->curve.size(), skipped.size() == 1 ? "" : "s", shown,
                  skipped.size() > kShown ? ", ..." : ""));
}

// Begins a further table, which must have the columns of the table above.
Expected<void> BeginNextTable(TablesBelow* rows, const TableLayout& above,
                              const TableLayout& next) {
  const auto has = [](const TableLayout& layout, int TableLayout::*column) {
    return layout.*column != kNoColumn;
  };
  bool same = above.per_area() == next.per_area();
  for (int TableLayout::*column : {&TableLayout::sigma, &TableLayout::time, &TableLayout::sweep,
                                   &TableLayout::irradiance, &TableLayout::temperature}) {
    same = same && has(above, column) == has(next, column);
  }
  if (!same) {
    return Fail(
        "expected the columns of the table above in the second table, found others: "
        "split the file",
        rows->file, next.first_row_line);
  }
  rows->starts.push_back(rows->table.curve.size());
  rows->heads.push_back(next.head.said);
  return {};
}

// Finds the unit of a current column that names none. If the head states a short-circuit current
// and the reading at zero volt shows the same number, the column has the unit of that statement.
void TakeUnitOfShortCircuit(Table* table, const TableLayout& layout) {
  constexpr double kAgrees = 0.02;
  const std::optional<StatedCurrent>& stated = layout.head.short_circuit;
  IvCurve& curve = table->curve;
  const Column& column = layout.columns[layout.current];
  if (!stated || stated->factor == 1 || !column.unit.empty() || table->per_area) return;
  if (curve.size() == 0) return;
  const auto nearest =
      std::min_element(curve.voltage_V.begin(), curve.voltage_V.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double shown = curve.current_A[nearest - curve.voltage_V.begin()];
  if (std::abs(std::abs(shown) - std::abs(stated->value)) > kAgrees * std::abs(stated->value)) {
    return;
  }
  for (double& current : curve.current_A) current *= stated->factor;
  curve.current_unit_known = true;
  table->per_area = stated->kind == ColumnKind::kCurrentDensity;
  Forget(About::kCurrentUnit, &curve.assumptions);
  curve.assumptions.emplace_back(
      fmt::format("column {} names no unit: taken in that of {}, with which it agrees",
                  Quoted(column.label), stated->source),
      About::kCurrentUnit);
}

// Turns the light of a Suns-Voc trace into currents. Isc is that of the options or of the head.
Expected<void> TakeTrace(const TableLayout& layout, const std::string& file,
                         const ReadOptions& options, Table* table) {
  if (!layout.columns[layout.current].light) return {};
  std::vector<std::string> labels;
  for (const Column& column : layout.columns) labels.push_back(column.label);
  const auto trace = FindSunsVoc(labels);
  std::optional<double> isc = options.isc_A;
  const std::optional<StatedCurrent>& stated = layout.head.short_circuit;
  if (!isc && stated) {
    isc = std::abs(stated->value) * stated->factor;
    table->per_area = stated->kind == ColumnKind::kCurrentDensity;
  }
  const auto current = LightToCurrent(*trace, isc, &table->curve);
  if (!current) return Fail(current.error().message, file, layout.first_row_line);
  return {};
}

// Turns a condition that differs between heads into a column. A head that does not state it keeps
// the value of the table above.
void SpreadCondition(TablesBelow* rows, std::optional<double> Sidecar::*condition,
                     std::vector<double>* column) {
  std::optional<double> value = rows->heads.front().*condition;
  bool differs = false;
  for (const Sidecar& head : rows->heads)
    differs = differs || (head.*condition && head.*condition != value);
  if (!value || !differs || !column->empty()) return;
  for (std::size_t i = 0; i < rows->heads.size(); ++i) {
    if (rows->heads[i].*condition) value = rows->heads[i].*condition;
    column->resize(rows->starts[i], *value);
  }
  (rows->table.head.*condition).reset();
}

// Numbers several tables without a sweep column as sweeps 1, 2, ... Conditions that differ between
// their heads become columns.
void NumberTables(TablesBelow* rows) {
  IvCurve& curve = rows->table.curve;
  if (rows->starts.empty() || !curve.sweep.empty()) return;
  rows->starts.push_back(curve.size());
  rows->heads.insert(rows->heads.begin(), rows->table.head);
  curve.assumptions.push_back(fmt::format("{} tables one below the other read as sweeps 1 to {}",
                                          rows->heads.size(), rows->heads.size()));
  SpreadCondition(rows, &Sidecar::irradiance_W_m2, &curve.irradiance_W_m2);
  SpreadCondition(rows, &Sidecar::temperature_C, &curve.temperature_C);
  for (std::size_t i = 0; i < rows->starts.size(); ++i) {
    curve.sweep.resize(rows->starts[i], static_cast<int>(i) + 1);
  }
}

Expected<Table> ReadTables(TablesBelow* rows) {
  Expected<TableLayout> layout = FindTableLayout(rows->text, rows->file, rows->options);
  if (!layout) return tl::unexpected(layout.error());
  rows->table.curve.assumptions = layout->assumptions;
  rows->table.curve.voltage_unit_known = !layout->columns[layout->voltage].unit.empty();
  rows->table.curve.current_unit_known = !layout->columns[layout->current].unit.empty();
  rows->table.head = layout->head.said;
  TakeLight(layout->columns[layout->current], &rows->table.curve, &rows->table.head);
  rows->table.per_area = layout->per_area();
  rows->table.name = ChannelName(layout->columns, layout->channel());
  rows->table.holds_curves =
      layout->sweep != kNoColumn && layout->columns[layout->sweep].kind == ColumnKind::kCurve;
  while (true) {
    Expected<std::optional<TableLayout>> next = ReadRows(rows, *layout);
    if (!next) return tl::unexpected(next.error());
    if (!*next) break;
    TRY(BeginNextTable(rows, *layout, **next));
    *layout = std::move(**next);
  }
  if (rows->table.curve.size() == 0 && rows->table.broken.empty()) {
    return Fail("expected rows of numbers below the header, found none", rows->file,
                layout->first_row_line);
  }
  SayWhatWasSkipped(&rows->table);
  TRY(TakeTrace(*layout, rows->file, rows->options, &rows->table));
  TakeUnitOfShortCircuit(&rows->table, *layout);
  NumberTables(rows);
  return std::move(rows->table);
}

}  // namespace

Expected<Table> ReadTable(std::string_view text, const std::string& file,
                          const ReadOptions& options, BrokenRows broken_rows) {
  TRY(CheckUtf8(text, file));
  TablesBelow below{text, file, options, broken_rows, {}, {}, {}};
  return ReadTables(&below);
}

}  // namespace lyrefit
