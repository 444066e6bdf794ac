#include "lyrefit/read/list_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/header_layout.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {
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

}  // namespace lyrefit
