#include "lyrefit/read/read_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/records.h"
#include "lyrefit/read/stated_results.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/table_reading.h"
#include "lyrefit/read/table_view.h"

namespace lyrefit {
namespace {

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

// Whether the field of the voltage is empty, as in a list of results without labels.
bool LacksVoltage(std::string_view line, const TableLayout& layout) {
  const auto fields = SplitFields(line, layout.delimiter);
  const std::size_t voltage = layout.voltage;
  return fields && voltage < fields->size() && (*fields)[voltage].empty();
}

// State while a table and the tables below it are read.
struct TablesBelow {
  std::string_view text;
  const std::string& file;
  BrokenRows broken_rows;
  std::vector<TableReading> readings;  // of the measurements side by side that are wanted
};

// Whether the lines up to line `before` (0: the end) contain no row of the table.
bool OnlyText(LineReader lines, int before, const TableLayout& layout) {
  bool below_text = false;
  for (std::string_view line; lines.NextContent(&line);) {
    if (before != 0 && lines.number() >= before) return true;
    if (!IsText(line, layout) && !(below_text && LacksVoltage(line, layout))) return false;
    below_text = true;
  }
  return true;
}

// Names the text below the tables. A short-circuit current in it counts where the head states none.
void SayWhatWasLeft(LineReader lines, std::vector<TableReading>* readings) {
  constexpr int kShown = 3;
  int count = 0;
  std::string shown;
  int first = 0;
  TableHead below;
  for (std::string_view line; lines.NextContent(&line);) {
    if (line.find_first_not_of(" \t,;|") == std::string_view::npos) continue;
    ReadHeadLine(line, lines.number(), HeadLine::kText, &below);
    if (count++ == 0) first = lines.number();
    if (count <= kShown) shown += (count == 1 ? "" : ", ") + Quoted(line);
  }
  if (count == 0) return;
  const std::string sentence =
      fmt::format("{} line{} of text below the table left aside, from line {} on: {}{}", count,
                  count == 1 ? "" : "s", first, shown, count > kShown ? ", ..." : "");
  for (TableReading& reading : *readings) {
    reading.table.curve.assumptions.push_back(sentence);
    auto& stated = reading.layout.head.short_circuit;
    if (!stated) stated = below.short_circuit;
  }
}

// Appends a row to all measurements. A row that some refuse and others take is an error of the
// former; one that none takes is the error that is returned.
Expected<void> TakeRow(BrokenRows broken_rows, TableRow* row, std::vector<TableReading>* readings) {
  std::vector<std::pair<TableReading*, Error>> refusing;
  bool taken = false;
  for (TableReading& reading : *readings) {
    if (reading.table.error) continue;
    const Expected<bool> read = reading.Take(row);
    taken = taken || (read && *read);
    if (read) continue;
    if (broken_rows == BrokenRows::kSetAside && reading.SetAside(read.error(), row)) continue;
    refusing.emplace_back(&reading, read.error());
  }
  if (refusing.empty()) return {};
  if (!taken) return tl::unexpected(std::move(refusing.front().second));
  for (auto& [reading, error] : refusing) reading->table.error = std::move(error);
  return {};
}

void LeaveOutPadding(TableReading* reading) {
  Table& table = reading->table;
  const std::size_t begin = reading->starts.empty() ? 0 : reading->starts.back();
  reading->padding += LeaveOutPadding(begin, &table.curve);
  table.lines.resize(table.curve.size());
  for (FurtherSweep& sweep : reading->further) {
    reading->padding += LeaveOutPadding(0, &sweep.curve);
    sweep.lines.resize(sweep.curve.size());
  }
}

void JoinFurther(std::vector<TableReading>* readings) {
  for (TableReading& reading : *readings) {
    LeaveOutPadding(&reading);
    JoinSweeps(reading.layout.columns, reading.layout.channel(), std::exchange(reading.further, {}),
               &reading.table.curve, &reading.table.lines);
  }
}

// The layouts of the next table, one for each measurement; empty if only text follows. Error: there
// is neither a table nor text.
Expected<std::vector<TableLayout>> NextLayouts(const TablesBelow& rows, const LineReader& lines,
                                               const Error& row_error) {
  std::vector<TableLayout> layouts;
  const TableLayout& above = rows.readings.front().layout;
  for (const TableReading& reading : rows.readings) {
    auto next = FindNextLayout(lines, rows.file, reading.options);
    if (!next || !OnlyText(lines, next->first_row_line, above)) break;
    layouts.push_back(std::move(*next));
  }
  if (layouts.size() == rows.readings.size()) return layouts;
  const bool any = std::any_of(rows.readings.begin(), rows.readings.end(),
                               [](const TableReading& one) { return one.table.curve.size() > 0; });
  if (any && OnlyText(lines, 0, above)) return std::vector<TableLayout>();
  return tl::unexpected(row_error);
}

// Reads rows up to the end of the text or the next table, whose layouts it returns.
Expected<std::vector<TableLayout>> ReadRows(TablesBelow* rows) {
  const TableLayout& layout = rows->readings.front().layout;
  for (TableReading& reading : rows->readings) reading.further.resize(reading.layout.more.size());
  TableRow row(layout.columns, layout.delimiter, rows->file);
  LineReader lines(rows->text, layout.first_row_offset, layout.first_row_line);
  std::size_t offset = lines.offset();
  for (std::string_view line; lines.NextContent(&line, &offset);) {
    if (line.find_first_not_of(" \t,;|") == std::string_view::npos) continue;
    if (StoppableReads::Stopped()) return FailAsStopped(rows->file);
    auto read = row.Split(line, lines.number());
    if (read) read = TakeRow(rows->broken_rows, &row, &rows->readings);
    if (read) continue;
    lines.StepBack(offset);
    JoinFurther(&rows->readings);
    TRY(auto next, NextLayouts(*rows, lines, read.error()));
    if (next.empty()) SayWhatWasLeft(lines, &rows->readings);
    return next;
  }
  JoinFurther(&rows->readings);
  return std::vector<TableLayout>();
}

void SayWhatWasSkipped(std::size_t padding, Table* table) {
  constexpr std::size_t kShown = 10;
  const std::vector<int>& skipped = table->skipped;
  SayPadding(padding, &table->curve);
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
Expected<void> BeginNextTable(const std::string& file, TableLayout next, TableReading* reading) {
  const auto has = [](const TableLayout& layout, int TableLayout::*column) {
    return layout.*column != kNoColumn;
  };
  bool same = reading->layout.per_area() == next.per_area();
  for (int TableLayout::*column : {&TableLayout::sigma, &TableLayout::time, &TableLayout::sweep,
                                   &TableLayout::irradiance, &TableLayout::temperature}) {
    same = same && has(reading->layout, column) == has(next, column);
  }
  if (!same) {
    return Fail(
        "expected the columns of the table above in the second table, found others: "
        "split the file",
        file, next.first_row_line);
  }
  reading->starts.push_back(reading->table.curve.size());
  reading->heads.push_back(next.head.said);
  reading->layout = std::move(next);
  return {};
}

TableReading Begin(TableLayout layout, const ReadOptions& options) {
  TableReading reading{options, std::move(layout)};
  Table& table = reading.table;
  const TableLayout& found = reading.layout;
  table.curve.assumptions = found.assumptions;
  table.curve.voltage_unit_known = !found.columns[found.voltage].unit.empty();
  table.curve.current_unit_known = !found.columns[found.current].unit.empty();
  table.head = found.head.said;
  TakeLight(found.columns[found.current], &table.curve, &table.head);
  table.per_area = found.per_area();
  table.name = found.device.empty()
                   ? ChannelName(found.columns, found.channel())
                   : fmt::format("{} {}", found.columns[found.device_column].label, found.device);
  table.of_device = !found.device.empty();
  table.holds_curves =
      found.sweep != kNoColumn && found.columns[found.sweep].kind == ColumnKind::kCurve;
  return reading;
}

constexpr char kOnlyZeros[] = "every row holds 0 V and 0 A: nothing was measured";

// Drops measurements side by side that hold only zeros, and names them.
void DropUnmeasured(std::vector<TableReading>* readings) {
  const auto is_empty = [](const TableReading& reading) {
    return !reading.table.error && reading.table.curve.size() == 0 && reading.padding > 0;
  };
  std::string names;
  for (const TableReading& reading : *readings) {
    if (is_empty(reading)) names += (names.empty() ? "" : ", ") + Quoted(reading.table.name);
  }
  const auto kept = std::stable_partition(readings->begin(), readings->end(),
                                          [&](const auto& one) { return !is_empty(one); });
  if (names.empty() || kept == readings->begin()) return;
  readings->erase(kept, readings->end());
  for (TableReading& reading : *readings) {
    reading.table.curve.assumptions.push_back(fmt::format("{} left aside: {}", names, kOnlyZeros));
  }
}

Expected<void> Finish(std::string_view text, const std::string& file, TableReading* reading) {
  Table& table = reading->table;
  if (table.error) return tl::unexpected(*table.error);
  if (table.curve.size() == 0 && table.broken.empty()) {
    return Fail(reading->padding == 0 ? "expected rows of numbers below the header, found none"
                                      : kOnlyZeros,
                file, reading->layout.first_row_line);
  }
  SayWhatWasSkipped(reading->padding, &table);
  table.curve.stated = ResultsOf(reading->layout.head.result_lines, reading->layout.columns,
                                 reading->layout.channels, reading->layout.channel());
  return SettleTable(text, file, reading);
}

Expected<void> CheckIsNoLog(std::string_view text, const std::string& file) {
  if (auto words = FindOperatingLog(text)) return Fail(std::move(*words), file);
  return {};
}

Expected<std::vector<Table>> ReadAll(std::string_view text, const std::string& file,
                                     std::vector<TableReading> readings, BrokenRows broken_rows) {
  TablesBelow rows{text, file, broken_rows, std::move(readings)};
  while (true) {
    TRY(std::vector<TableLayout> next, ReadRows(&rows));
    if (next.empty()) break;
    for (std::size_t i = 0; i < next.size(); ++i) {
      TRY(BeginNextTable(file, std::move(next[i]), &rows.readings[i]));
    }
  }
  std::vector<Table> tables;
  DropUnmeasured(&rows.readings);
  for (TableReading& reading : rows.readings) {
    if (auto finished = Finish(text, file, &reading); !finished)
      reading.table.error = finished.error();
    tables.push_back(std::move(reading.table));
  }
  return tables;
}

}  // namespace

Expected<Table> ReadTable(std::string_view text, const std::string& file,
                          const ReadOptions& options, BrokenRows broken_rows) {
  TRY(CheckUtf8(text, file));
  TRY(CheckIsNoLog(text, file));
  TRY(TableLayout layout, FindTableLayout(text, file, options));
  TRY(std::vector<Table> tables,
      ReadAll(text, file, {Begin(std::move(layout), options)}, broken_rows));
  if (tables.front().error) return tl::unexpected(*tables.front().error);
  return std::move(tables.front());
}

Expected<std::vector<Table>> ReadTables(std::string_view text, const std::string& file,
                                        const ReadOptions& options, BrokenRows broken_rows) {
  TRY(CheckUtf8(text, file));
  TRY(CheckIsNoLog(text, file));
  ReadOptions one = options;
  std::vector<std::string> wanted = {options.column};
  if (options.column.empty()) {
    one.column = "1";
    TRY(const TableLayout first, FindTableLayout(text, file, one));
    wanted = MeasurementsOf(first);
  }
  std::vector<TableReading> readings;
  for (const std::string& column : wanted) {
    if (StoppableReads::Stopped()) return FailAsStopped(file);
    one.column = column;
    TRY(TableLayout layout, FindTableLayout(text, file, one));
    readings.push_back(Begin(std::move(layout), one));
  }
  return ReadAll(text, file, std::move(readings), broken_rows);
}

}  // namespace lyrefit
