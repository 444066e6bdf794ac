#include "lyrefit/read/table_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/label.h"

namespace lyrefit {
namespace {

Fields LabelsOf(const std::vector<Column>& columns) {
  Fields labels;
  for (const Column& column : columns) labels.push_back(column.label);
  return labels;
}

// The usable column of `kind`; if the only one is unusable, its error.
Expected<int> PickColumn(const TableLayout& layout, ColumnKind kind, const HeaderPlace& place) {
  int usable = kNoColumn;
  int refused = kNoColumn;
  const bool required = kind == ColumnKind::kVoltage || kind == ColumnKind::kCurrent;
  for (int i = 0; i < static_cast<int>(layout.columns.size()); ++i) {
    const Column& column = layout.columns[i];
    if (column.kind != kind) continue;
    if (!column.refusal.empty()) {
      if (refused == kNoColumn) refused = i;
    } else if (usable == kNoColumn) {
      usable = i;
    } else if (required) {
      return place.Refuse(fmt::format("expected one {} column, found two: {} and {}",
                                      kind == ColumnKind::kVoltage ? "voltage" : "current",
                                      Quoted(layout.columns[usable].label), Quoted(column.label)),
                          i);
    }
  }
  if (usable == kNoColumn && refused != kNoColumn) {
    return place.Refuse(layout.columns[refused].refusal, refused);
  }
  return usable;
}

// Error for a missing pair of voltage and current, at the position of the column that causes it.
tl::unexpected<Error> NoChannel(const TableLayout& layout, const ReadOptions& options,
                                const HeaderPlace& place) {
  for (const std::string* wish : {&options.voltage_column, &options.current_column}) {
    if (wish->empty() || FindColumn(layout.columns, *wish)) continue;
    return place.Refuse(fmt::format("expected a column {} in the header, found {}", Quoted(*wish),
                                    ListOf(LabelsOf(layout.columns))),
                        0);
  }
  for (const ColumnKind kind :
       {ColumnKind::kVoltage, ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
    TRY(PickColumn(layout, kind, place));
  }
  return place.Refuse("expected a voltage and a current that belong together", 0);
}

Expected<void> PickChannel(const ReadOptions& options, const HeaderPlace& place,
                           TableLayout* layout) {
  layout->channels = FindChannels(layout->columns);
  if (layout->channels.empty()) return NoChannel(*layout, options, place);
  for (const std::string* wish : {&options.voltage_column, &options.current_column}) {
    if (!wish->empty() && !FindColumn(layout->columns, *wish)) {
      return NoChannel(*layout, options, place);
    }
  }
  const Expected<Channel> chosen = ChooseChannel(layout->columns, layout->channels, options.column);
  if (!chosen) {
    const std::size_t blamed = options.column.empty() ? 1 : 0;
    return place.Refuse(chosen.error().message, layout->channels[blamed].current);
  }
  for (const Channel& channel : layout->channels) {
    TRY(ApplyUnitWishes(options, channel, &layout->columns));
  }
  layout->voltage = chosen->voltage;
  layout->current = chosen->current;
  layout->more = chosen->more;
  return {};
}

Expected<void> PickColumns(const ReadOptions& options, const HeaderPlace& place,
                           TableLayout* layout) {
  TRY(PickChannel(options, place, layout));
  const std::pair<ColumnKind, int*> wanted[] = {{ColumnKind::kSigma, &layout->sigma},
                                                {ColumnKind::kTime, &layout->time},
                                                {ColumnKind::kSweep, &layout->sweep},
                                                {ColumnKind::kIrradiance, &layout->irradiance},
                                                {ColumnKind::kTemperature, &layout->temperature}};
  for (const auto& [kind, index] : wanted) {
    TRY(*index, PickColumn(*layout, kind, place));
  }
  if (layout->sweep == kNoColumn) layout->sweep = *PickColumn(*layout, ColumnKind::kCurve, place);
  if (layout->irradiance != kNoColumn && IsLightOfTrace(layout->columns, layout->irradiance)) {
    layout->assumptions.push_back(
        fmt::format("column {} is the light of the Suns-Voc trace beside it, not that of a sweep",
                    Quoted(layout->columns[layout->irradiance].label)));
    layout->irradiance = kNoColumn;
  }
  if (layout->more.empty()) return {};
  if (layout->sweep != kNoColumn) {
    return place.Refuse("expected columns of both directions or a column of sweeps, found both",
                        layout->sweep);
  }
  layout->time = kNoColumn;  // the time of a row belongs to one of its sweeps
  return {};
}

// Drops a time column of text, such as a time of day, and a direction that is none of a sweep.
// Neither is a reason to refuse the curve.
void DropTextColumns(std::string_view row, TableLayout* layout) {
  const auto fields = SplitFields(row, layout->delimiter);
  if (!fields) return;
  const auto is_text = [&](int place) {
    const auto field = static_cast<std::size_t>(place);
    return place != kNoColumn && field < fields->size() && !(*fields)[field].empty() &&
           !ParseNumber((*fields)[field], layout->delimiter != ',');
  };
  if (is_text(layout->time)) layout->time = kNoColumn;
  if (!is_text(layout->sweep)) return;
  const bool names_direction =
      LowerCase(layout->columns[layout->sweep].label).find("direction") != std::string::npos;
  const bool stated = ReadTag((*fields)[layout->sweep]).direction != SweepDirection::kUnknown;
  if (names_direction && !stated) layout->sweep = kNoColumn;
}

// Whether a column belongs to one of the measurements side by side. Their number is said in place of
// their columns.
bool IsOfChannel(const TableLayout& layout, int column) {
  return std::any_of(layout.channels.begin(), layout.channels.end(), [&](const Channel& channel) {
    const auto holds = [column](const ColumnPair& pair) {
      return pair.voltage == column || pair.current == column;
    };
    return holds(channel) || std::any_of(channel.more.begin(), channel.more.end(), holds);
  });
}

void SayWhatWasAssumed(TableLayout* layout) {
  for (int i = 0; i < static_cast<int>(layout->columns.size()); ++i) {
    const Column& column = layout->columns[i];
    if (!IsUsed(*layout, i)) continue;
    if (column.kind == ColumnKind::kTemperature && column.offset != 0) {
      layout->assumptions.push_back(
          fmt::format("column {} converted from kelvin to degrees Celsius", Quoted(column.label)));
    } else if (column.factor != 1 && !column.unit.empty()) {
      layout->assumptions.push_back(
          fmt::format("column {} multiplied by {} to get {}", Quoted(column.label), column.factor,
                      column.kind == ColumnKind::kVoltage          ? "V"
                      : column.kind == ColumnKind::kTime           ? "s"
                      : column.kind == ColumnKind::kIrradiance     ? "W/m2"
                      : column.kind == ColumnKind::kCurrentDensity ? "A/cm2"
                                                                   : "A"));
    }
  }
  const char* const current_unit = layout->per_area() ? "mA/cm2" : "A";
  for (const auto& [index, unit, about] : {std::tuple(layout->voltage, "V", About::kReading),
                                           {layout->current, current_unit, About::kCurrentUnit}}) {
    const Column& column = layout->columns[index];
    if (!column.unit.empty() || column.label.empty()) continue;
    layout->assumptions.emplace_back(
        fmt::format("column {} names no unit: taken as {}", Quoted(column.label), unit), about);
  }
  if (const std::size_t count = layout->channels.size(); count > 1) {
    layout->assumptions.push_back(fmt::format("one of {} measurements side by side", count));
  }
}

// Columns of voltage and current in a table without a header: the first two, unless the options
// select others.
Expected<Channel> PlacesWithoutHeader(const std::vector<Column>& columns, const HeaderPlace& place,
                                      const ReadOptions& options) {
  std::optional<int> places[2];
  const std::string* wishes[] = {&options.voltage_column, &options.current_column};
  for (int i = 0; i < 2; ++i) {
    if (wishes[i]->empty()) continue;
    places[i] = FindColumn(columns, *wishes[i]);
    if (places[i]) continue;
    return place.Refuse(fmt::format("column {} was asked for, but the table has no header and {} "
                                    "columns: name them by their place, from 1",
                                    Quoted(*wishes[i]), columns.size()),
                        0);
  }
  if (!places[0]) places[0] = places[1] == 0 ? 1 : 0;
  if (!places[1]) places[1] = places[0] == 1 ? 0 : 1;
  return Channel{*places[0], *places[1]};
}

}  // namespace

std::string ListOf(const Fields& names) {
  constexpr std::size_t kShown = 40;
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) {
    list += (i == 0 ? "" : ", ") + Quoted(names[i]);
  }
  if (names.size() > kShown) list += fmt::format(" and {} more", names.size() - kShown);
  return list;
}

void SayWhatIsNotUsed(TableLayout* layout) {
  Fields unused;
  for (int i = 0; i < static_cast<int>(layout->columns.size()); ++i) {
    const std::string& label = layout->columns[i].label;
    if (!label.empty() && !IsUsed(*layout, i) && !IsOfChannel(*layout, i)) unused.push_back(label);
  }
  if (unused.empty()) return;
  layout->assumptions.push_back(
      fmt::format("column{} not used: {}", unused.size() == 1 ? "" : "s", ListOf(unused)));
}

bool IsUsed(const TableLayout& layout, int column) {
  for (const int used : {layout.voltage, layout.current, layout.sigma, layout.time, layout.sweep,
                         layout.irradiance, layout.temperature, layout.device_column}) {
    if (used == column) return true;
  }
  return std::any_of(layout.more.begin(), layout.more.end(), [column](const ColumnPair& pair) {
    return pair.voltage == column || pair.current == column;
  });
}

Expected<TableLayout> LayoutOfHeader(const TableLine& header, const HeaderPlace& place,
                                     std::string_view next_line, const ReadOptions& options) {
  TableLayout layout;
  layout.delimiter = header.delimiter;
  layout.columns = header.columns;
  TRY(PickColumns(options, place, &layout));
  DropTextColumns(next_line, &layout);
  SayWhatWasAssumed(&layout);
  return layout;
}

Expected<TableLayout> LayoutWithoutHeader(const TableLine& row, const HeaderPlace& place,
                                          const ReadOptions& options) {
  // "0,5,7,48" may be two numbers with decimal commas.
  const bool may_be_decimal_commas =
      row.delimiter == ',' && row.fields.size() == 4 &&
      std::all_of(row.fields.begin(), row.fields.end(), [](const std::string& field) {
        return field.find_first_of(".eE") == std::string::npos;
      });
  if (may_be_decimal_commas) {
    return place.Refuse(
        "expected two columns, found four whole numbers without a header: with a decimal comma, "
        "separate the columns by ';' or tab",
        0);
  }
  TableLayout layout;
  layout.delimiter = row.delimiter;
  layout.columns.resize(row.fields.size());
  TRY(const Channel channel, PlacesWithoutHeader(layout.columns, place, options));
  TRY(ApplyUnitWishes(options, channel, &layout.columns));
  layout.channels = {channel};
  layout.voltage = channel.voltage;
  layout.current = channel.current;
  const std::string& unit = options.current_unit;
  layout.assumptions.push_back(fmt::format(
      "no header line: column {} taken as the voltage in {}, column {} as the current{}",
      layout.voltage + 1, options.voltage_unit.empty() ? "V" : options.voltage_unit,
      layout.current + 1, unit.empty() ? "" : " in " + unit));
  if (unit.empty()) {
    layout.assumptions.emplace_back(
        fmt::format("column {} names no unit: taken as A", layout.current + 1),
        About::kCurrentUnit);
  }
  if (row.fields.size() > 2) {
    layout.assumptions.push_back(fmt::format("{} further columns not used", row.fields.size() - 2));
  }
  return layout;
}

namespace {

constexpr std::size_t kMostDevices = 64;

// Whether a label is that of a device, with or without a word such as "number" after it.
bool NamesDevice(const std::string& label) {
  constexpr std::string_view kNames[] = {"channel", "chan",   "ch",     "pixel",  "px",
                                         "device",  "dut",    "cell",   "sample", "module",
                                         "subcell", "string", "contact"};
  constexpr std::string_view kEndings[] = {"",   "number", "no",    "nr",
                                           "id", "name",   "index", "label"};
  const std::vector<LabelWord> words = SplitLabel(label);
  const std::string name = JoinWords(words, 0, words.size());
  return std::any_of(std::begin(kNames), std::end(kNames), [&](std::string_view device) {
    return name.substr(0, device.size()) == device &&
           std::find(std::begin(kEndings), std::end(kEndings),
                     std::string_view(name).substr(device.size())) != std::end(kEndings);
  });
}

// The voltages that the rows of a device cover.
struct Covered {
  double low = 0;
  double high = 0;
  int rows = 0;

  void Add(double voltage) {
    low = rows == 0 ? voltage : std::min(low, voltage);
    high = rows == 0 ? voltage : std::max(high, voltage);
    ++rows;
  }
};

// The devices that a column holds; none if its values are no devices.
std::vector<std::string> DevicesIn(const TableLayout& layout, std::size_t place, LineReader lines) {
  constexpr int kLeastRows = 5;  // the parameters of one diode
  std::vector<std::string> order;
  std::map<std::string, Covered> covered;
  Covered all;
  const auto voltage_at = static_cast<std::size_t>(layout.voltage);
  for (std::string_view line; lines.NextContent(&line);) {
    const auto fields = SplitFields(line, layout.delimiter);
    if (!fields || fields->size() <= std::max(place, voltage_at)) break;
    const auto voltage = ParseNumber((*fields)[voltage_at], layout.delimiter != ',');
    if (!voltage && !IsMissingReading((*fields)[voltage_at], layout.delimiter != ',')) break;
    if (!voltage || *voltage != *voltage) continue;
    const auto [found, is_new] = covered.try_emplace((*fields)[place]);
    if (is_new) order.push_back((*fields)[place]);
    if (order.size() > kMostDevices) return {};
    found->second.Add(*voltage);
    all.Add(*voltage);
  }
  const bool curves = std::all_of(covered.begin(), covered.end(), [&](const auto& entry) {
    const Covered& own = entry.second;
    return own.rows >= kLeastRows && own.high - own.low >= 0.5 * (all.high - all.low);
  });
  if (!curves || order.size() < 2) return {};
  return order;
}

}  // namespace

void FindDevices(LineReader rows, TableLayout* layout) {
  const bool of_curves =
      layout->sweep != kNoColumn && layout->columns[layout->sweep].kind == ColumnKind::kCurve;
  if (of_curves || layout->channels.size() != 1) return;
  for (int place = 0; place < static_cast<int>(layout->columns.size()); ++place) {
    if (IsUsed(*layout, place) || !NamesDevice(layout->columns[place].label)) continue;
    layout->devices = DevicesIn(*layout, static_cast<std::size_t>(place), rows);
    if (layout->devices.empty()) continue;
    layout->device_column = place;
    return;
  }
}

}  // namespace lyrefit
