#include "lyrefit/read/operating_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/table_reading.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {
namespace {

enum OperatingColumn { kAtTime, kAtIrradiance, kAtTemperature, kAtVoltage, kAtCurrent, kOperating };

constexpr const char* kOperatingNames[] = {"time", "irradiance", "temperature", "vmp", "imp"};

struct OperatingLayout {
  char delimiter = 0;
  std::vector<Column> columns;
  std::array<int, kOperating> at;
};

// The letters before a unit or a blank: "vmp" of "V_mp (V)", "vmp" of "vmp_V".
std::string NameOf(std::string_view label) {
  std::string name;
  for (const char c : label.substr(0, label.find_first_of("([/"))) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return name;
}

bool IsOneOf(const std::string& name, std::initializer_list<const char*> names, char unit) {
  return std::any_of(names.begin(), names.end(), [&](const char* one) {
    return name == one || name == std::string(one) + unit || name == std::string(one) + 'm' + unit;
  });
}

int KindOf(const std::string& label, Column* column) {
  const std::string name = NameOf(label);
  if (IsOneOf(name, {"time", "date", "timestamp", "datetime", "tmst", "dateandtime"}, 's')) {
    return kAtTime;
  }
  if (IsOneOf(name, {"vmp", "vmpp", "vdc", "voltage", "udc", "ump", "vmax"}, 'v')) {
    *column = ColumnSaidToBe(ColumnKind::kVoltage, label);
    return kAtVoltage;
  }
  if (IsOneOf(name, {"imp", "impp", "idc", "current", "imax"}, 'a')) {
    *column = ColumnSaidToBe(ColumnKind::kCurrent, label);
    return kAtCurrent;
  }
  if (!column->refusal.empty()) return kOperating;
  if (column->kind == ColumnKind::kIrradiance) return kAtIrradiance;
  if (column->kind == ColumnKind::kTemperature) return kAtTemperature;
  if (column->kind == ColumnKind::kVoltage) return kAtVoltage;
  if (column->kind == ColumnKind::kCurrent) return kAtCurrent;
  return kOperating;
}

OperatingLayout LayoutOf(std::string_view header) {
  OperatingLayout best;
  best.at.fill(-1);
  for (const char delimiter : kFieldMarks) {
    const auto fields = SplitFields(header, delimiter);
    if (!fields || fields->size() < kOperating) continue;
    OperatingLayout layout;
    layout.at.fill(-1);
    layout.delimiter = delimiter;
    layout.columns = RecogniseAll(*fields);
    for (std::size_t i = 0; i < fields->size(); ++i) {
      const int kind = KindOf((*fields)[i], &layout.columns[i]);
      if (kind < kOperating && layout.at[kind] < 0) layout.at[kind] = static_cast<int>(i);
    }
    return layout;
  }
  return best;
}

// The layout with the input of an inverter that `wish` names: "Vpv2" and "Ipv2" of "2". Error: several
// inputs and no wish, or a wish that names none.
Expected<OperatingLayout> WithInput(OperatingLayout layout, const std::string& wish) {
  const std::vector<Channel> channels = FindChannels(layout.columns);
  const bool numbered = std::all_of(channels.begin(), channels.end(), [&](const Channel& channel) {
    return !layout.columns[channel.current].tag.device.empty();
  });
  if (wish.empty() && (channels.size() < 2 || !numbered)) return layout;
  TRY(const Channel chosen, ChooseChannel(layout.columns, channels, wish));
  layout.at[kAtVoltage] = chosen.voltage;
  layout.at[kAtCurrent] = chosen.current;
  return layout;
}

// What a table without a column needs.
const char* HowToAdd(int kind) {
  const bool sensor = kind == kAtIrradiance || kind == kAtTemperature;
  return sensor ? ": a trend compares each row with what the module gives under its light and "
                  "temperature; join the readings of their sensors to the rows by time"
                : "";
}

// The order that the dates of the rows tell.
Expected<DateOrder> OrderOfDates(LineReader lines, const OperatingLayout& layout,
                                 const std::string& path) {
  TableRow row(layout.columns, layout.delimiter, path);
  DateOrder order = DateOrder::kUnknown;
  for (std::string_view line; lines.NextContent(&line);) {
    TRY(row.Take(line, lines.number()));
    const DateOrder own = OrderOfDate(row[layout.at[kAtTime]]);
    if (own == DateOrder::kUnknown || own == order) continue;
    if (order != DateOrder::kUnknown) {
      return row.RefuseField(layout.at[kAtTime], "day and month in the order of the rows before");
    }
    order = own;
  }
  return order;
}

Expected<double> NumberOrMissing(TableRow* row, int field) {
  const std::string_view text = TrimBlanks((*row)[field]);
  if (text.empty() || IsMissingWord(text)) return kUnknown;
  return row->Value(field);
}

}  // namespace

Expected<std::vector<OperatingReading>> ReadOperatingTable(const std::string& path,
                                                           std::int64_t largest_file_bytes,
                                                           const std::string& input) {
  TRY(const DecodedText text, ReadDecodedFile(path, largest_file_bytes));
  LineReader lines(text.text);
  std::string_view line;
  if (!lines.NextContent(&line)) {
    return Fail("the file holds no data, only blank lines and comments", path);
  }
  const auto chosen = WithInput(LayoutOf(line), input);
  if (!chosen) return Fail(chosen.error().message, path, lines.number(), 1);
  const OperatingLayout& layout = *chosen;
  for (int kind = 0; kind < kOperating; ++kind) {
    if (layout.at[kind] >= 0) continue;
    return Fail(fmt::format("expected a header with the columns time, irradiance, temperature, vmp "
                            "and imp, found none for {}{}",
                            kOperatingNames[kind], HowToAdd(kind)),
                path, lines.number(), 1);
  }
  TableRow row(layout.columns, layout.delimiter, path);
  TRY(const DateOrder order, OrderOfDates(lines, layout, path));
  constexpr DateOrder kEither = DateOrder::kDayFirst;
  std::vector<OperatingReading> points;
  while (lines.NextContent(&line)) {
    TRY(row.Take(line, lines.number()));
    OperatingReading point;
    // A row without a date is counted, unless its day and month are not told apart.
    const std::string_view date = row[layout.at[kAtTime]];
    point.time_s = ReadDateTime(date, order).value_or(kUnknown);
    if (!std::isfinite(point.time_s) && (points.empty() || ReadDateTime(date, kEither))) {
      return row.RefuseField(layout.at[kAtTime], "a date such as 2025-03-12 10:30");
    }
    TRY(point.irradiance_W_m2, NumberOrMissing(&row, layout.at[kAtIrradiance]));
    TRY(point.temperature_C, NumberOrMissing(&row, layout.at[kAtTemperature]));
    TRY(point.voltage_V, NumberOrMissing(&row, layout.at[kAtVoltage]));
    TRY(point.current_A, NumberOrMissing(&row, layout.at[kAtCurrent]));
    points.push_back(point);
  }
  return points;
}

}  // namespace lyrefit
