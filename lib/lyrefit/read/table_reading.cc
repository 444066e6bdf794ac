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

}  // namespace

Expected<bool> TableReading::TakeFurther(std::size_t i, TableRow* row) {
  const ColumnPair& pair = layout.more[i];
  if (IsPastEnd(*row, pair)) return false;
  if (options.skip_missing && IsMissing(*row, pair, layout.delimiter)) {
    std::vector<int>& skipped = table.skipped;
    if (skipped.empty() || skipped.back() != row->number()) skipped.push_back(row->number());
    return true;
  }
  IvCurve* const curve = &further[i].curve;
  TRY(TakeFields({{pair.voltage, &curve->voltage_V},
                  {pair.current, &curve->current_A},
                  {layout.sigma, &curve->sigma_A},
                  {layout.irradiance, &curve->irradiance_W_m2},
                  {layout.temperature, &curve->temperature_C}},
                 kNoColumn, nullptr, row));
  further[i].lines.push_back(row->number());
  return true;
}

Expected<bool> TableReading::Take(TableRow* row) {
  const ColumnPair first = layout.channel();
  const bool side_by_side = layout.channels.size() > 1 || !layout.more.empty();
  const bool ended = side_by_side && IsPastEnd(*row, first);
  if (ended && layout.more.empty()) return false;
  TRY(row->CheckLength());
  if (!layout.device.empty() && (*row)[layout.device_column] != layout.device) return true;
  bool taken = !ended;
  for (std::size_t i = 0; i < layout.more.size(); ++i) {
    TRY(const bool another, TakeFurther(i, row));
    taken = taken || another;
  }
  if (ended) return taken;
  if (options.skip_missing && IsMissing(*row, first, layout.delimiter)) {
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

bool TableReading::SetAside(const Error& error, TableRow* row) {
  const int column = layout.sweep;
  if (column == kNoColumn || !row->CheckLength()) return false;
  const Expected<int> sweep = row->WholeNumber(column);
  if (sweep) table.broken.try_emplace(*sweep, error);
  return sweep.has_value();
}

}  // namespace lyrefit
