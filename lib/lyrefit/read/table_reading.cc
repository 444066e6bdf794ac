#include "lyrefit/read/table_reading.h"

#include <array>
#include <initializer_list>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

bool IsMissing(const TableRow& row, const ColumnPair& pair, char delimiter) {
  return IsMissingReading(row[pair.voltage], delimiter != ',') ||
         IsMissingReading(row[pair.current], delimiter != ',');
}

// Whether a pair has ended: of pairs side by side, some may be shorter than others.
bool IsPastEnd(const TableRow& row, const ColumnPair& pair) {
  const auto empty = [&](int field) { return field >= row.size() || row[field].empty(); };
  return empty(pair.voltage) && empty(pair.current);
}

// Appends the fields to their lists, and the number of the sweep if `sweeps` is its column,
// completely or not at all.
Expected<void> TakeFields(std::initializer_list<std::pair<int, std::vector<double>*>> fields,
                          int sweep_field, std::vector<int>* sweeps, TableRow* row) {
  std::array<double, 6> values;
  std::size_t count = 0;
  for (const auto& [field, list] : fields) {
    if (field == kNoColumn) continue;
    TRY(values[count++], row->Value(field));
  }
  if (sweep_field != kNoColumn) {
    TRY(const int sweep, row->WholeNumber(sweep_field));
    sweeps->push_back(sweep);
  }
  count = 0;
  for (const auto& [field, list] : fields) {
    if (field != kNoColumn) list->push_back(values[count++]);
  }
  return {};
}

Expected<bool> TakeFurther(const ColumnPair& pair, TableRow* row, TableReading* reading,
                           FurtherSweep* sweep) {
  const TableLayout& layout = reading->layout;
  if (IsPastEnd(*row, pair)) return false;
  if (reading->options.skip_missing && IsMissing(*row, pair, layout.delimiter)) {
    std::vector<int>& skipped = reading->table.skipped;
    if (skipped.empty() || skipped.back() != row->number()) skipped.push_back(row->number());
    return true;
  }
  IvCurve* const curve = &sweep->curve;
  TRY(TakeFields({{pair.voltage, &curve->voltage_V},
                  {pair.current, &curve->current_A},
                  {layout.sigma, &curve->sigma_A},
                  {layout.irradiance, &curve->irradiance_W_m2},
                  {layout.temperature, &curve->temperature_C}},
                 kNoColumn, nullptr, row));
  sweep->lines.push_back(row->number());
  return true;
}

}  // namespace

Expected<bool> TakeRow(TableRow* row, TableReading* reading) {
  const TableLayout& layout = reading->layout;
  const ColumnPair first = layout.channel();
  const bool side_by_side = layout.channels.size() > 1 || !layout.more.empty();
  const bool ended = side_by_side && IsPastEnd(*row, first);
  if (ended && layout.more.empty()) return false;
  TRY(row->CheckLength());
  if (!layout.device.empty() && (*row)[layout.device_column] != layout.device) return true;
  bool taken = !ended;
  for (std::size_t i = 0; i < layout.more.size(); ++i) {
    TRY(const bool further, TakeFurther(layout.more[i], row, reading, &reading->further[i]));
    taken = taken || further;
  }
  if (ended) return taken;
  Table& table = reading->table;
  if (reading->options.skip_missing && IsMissing(*row, first, layout.delimiter)) {
    table.skipped.push_back(row->number());
    return true;
  }
  IvCurve* const curve = &table.curve;
  TRY(TakeFields({{layout.voltage, &curve->voltage_V},
                  {layout.current, &curve->current_A},
                  {layout.sigma, &curve->sigma_A},
                  {layout.time, &curve->time_s},
                  {layout.irradiance, &curve->irradiance_W_m2},
                  {layout.temperature, &curve->temperature_C}},
                 layout.sweep, &curve->sweep, row));
  table.lines.push_back(row->number());
  return true;
}

bool SetAside(const Error& error, TableRow* row, TableReading* reading) {
  const int column = reading->layout.sweep;
  if (column == kNoColumn || !row->CheckLength()) return false;
  const Expected<int> sweep = row->WholeNumber(column);
  if (sweep) reading->table.broken.try_emplace(*sweep, error);
  return sweep.has_value();
}

}  // namespace lyrefit
