#include "lyrefit/read/table_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <tuple>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/curve/sweep_order.h"

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

namespace {

// Finds the unit of a current column that names none. If the head, or text below the table, states a
// short-circuit current and the reading at zero volt shows the same number, the column has the unit of
// that statement; if a density, or a column without a name, shows the value in A/cm2, that unit.
void TakeUnitOfShortCircuit(Table* table, const TableLayout& layout) {
  constexpr double kAgrees = 0.02;
  const std::optional<StatedCurrent>& stated = layout.head.short_circuit;
  IvCurve& curve = table->curve;
  const Column& column = layout.columns[layout.current];
  if (!stated || !column.unit.empty() || curve.size() == 0) return;
  const auto nearest =
      std::min_element(curve.voltage_V.begin(), curve.voltage_V.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double shown = std::abs(curve.current_A[nearest - curve.voltage_V.begin()] / column.factor);
  const auto agrees = [shown](double value) {
    return std::abs(shown - std::abs(value)) <= kAgrees * std::abs(value);
  };
  const bool density = stated->kind == ColumnKind::kCurrentDensity;
  const bool same_unit = agrees(stated->value);
  const bool may_be_density = column.label.empty() || column.kind == ColumnKind::kCurrentDensity;
  const bool base_unit =
      !same_unit && density && may_be_density && agrees(stated->value * stated->factor);
  if (!same_unit && !base_unit) return;
  if (!density && (stated->factor == 1 || table->per_area)) return;
  const double factor = base_unit ? 1 : stated->factor;
  for (double& current : curve.current_A) current *= factor / column.factor;
  curve.current_unit_known = true;
  table->per_area = density;
  const std::string unit = (base_unit ? "A/cm2 by " : "the unit of ") + stated->source;
  Forget(About::kCurrentUnit, &curve.assumptions);
  const std::string name =
      column.label.empty() ? std::to_string(layout.current + 1) : Quoted(column.label);
  curve.assumptions.emplace_back(
      fmt::format("column {} names no unit: taken in {}, with which it agrees", name, unit),
      About::kCurrentUnit);
}

// The short-circuit current of the measurement under load beside a Suns-Voc trace.
std::optional<double> CurrentUnderLoad(std::string_view text, const std::string& file,
                                       const TableReading& trace, Table* table) {
  const auto place = ChannelUnderLoad(trace.layout.columns, trace.layout.channels);
  if (!place) return std::nullopt;
  ReadOptions options = trace.options;
  options.column = std::to_string(*place + 1);
  Expected<Table> load = ReadTable(text, file, options);
  if (!load || !load->curve.sweep.empty()) return std::nullopt;
  TurnLoadSign(&load->curve);
  const KeyPoints points = FindKeyPoints(load->curve.voltage_V, load->curve.current_A);
  if (!(points.short_circuit_current_A > 0)) return std::nullopt;
  table->per_area = load->per_area;
  return points.short_circuit_current_A;
}

// Makes the curve of a Suns-Voc trace. Isc is that of the options, of the head or of the measurement
// under load. Currents in place of the light are such a curve already.
Expected<void> TakeTrace(std::string_view text, const std::string& file,
                         const TableReading& reading, Table* table) {
  const TableLayout& layout = reading.layout;
  const Column& column = layout.columns[layout.current];
  if (!column.light) {
    if (column.tag.light == SweepLight::kSunsVoc) SayIsTrace(&table->curve);
    return {};
  }
  std::vector<std::string> labels;
  for (const Column& one : layout.columns) labels.push_back(one.label);
  const SunsVocColumns trace = FindSunsVoc(labels).value_or(SunsVocColumns{});
  std::optional<double> isc = reading.options.isc_A;
  const std::optional<StatedCurrent>& stated = layout.head.short_circuit;
  if (!isc && stated) {
    isc = std::abs(stated->value) * stated->factor;
    table->per_area = stated->kind == ColumnKind::kCurrentDensity;
  }
  if (!isc) isc = CurrentUnderLoad(text, file, reading, table);
  const auto current = LightToCurrent(trace, isc, &table->curve);
  if (!current) return Fail(current.error().message, file, layout.first_row_line);
  return {};
}

// Turns a condition that differs between heads into a column. A head that does not state it keeps
// the value of the table above.
void SpreadCondition(std::optional<double> Sidecar::*condition, std::vector<double>* column,
                     TableReading* reading) {
  std::optional<double> value = reading->heads.front().*condition;
  bool differs = false;
  for (const Sidecar& head : reading->heads)
    differs = differs || (head.*condition && head.*condition != value);
  if (!value || !differs || !column->empty()) return;
  for (std::size_t i = 0; i < reading->heads.size(); ++i) {
    if (reading->heads[i].*condition) value = reading->heads[i].*condition;
    column->resize(reading->starts[i], *value);
  }
  (reading->table.head.*condition).reset();
}

// Numbers several tables without a sweep column as sweeps 1, 2, ... Conditions that differ between
// their heads become columns.
void NumberTables(TableReading* reading) {
  IvCurve& curve = reading->table.curve;
  if (reading->starts.empty() || !curve.sweep.empty()) return;
  reading->starts.push_back(curve.size());
  reading->heads.insert(reading->heads.begin(), reading->table.head);
  curve.assumptions.push_back(fmt::format("{} tables one below the other read as sweeps 1 to {}",
                                          reading->heads.size(), reading->heads.size()));
  SpreadCondition(&Sidecar::irradiance_W_m2, &curve.irradiance_W_m2, reading);
  SpreadCondition(&Sidecar::temperature_C, &curve.temperature_C, reading);
  for (std::size_t i = 0; i < reading->starts.size(); ++i) {
    curve.sweep.resize(reading->starts[i], static_cast<int>(i) + 1);
  }
}

bool IsZero(const std::vector<double>& column) {
  return !column.empty() &&
         std::all_of(column.begin(), column.end(), [](double value) { return value == 0; });
}

// Whether a current flows at 0 V that only light makes.
bool IsLit(IvCurve curve) {
  TurnLoadSign(&curve);
  curve.irradiance_known = true;
  curve.conditions.irradiance_W_m2 = 0;
  return !IsDark(curve);
}

// Leaves out columns that are 0 throughout where no sensor gave them: a temperature, and the
// irradiance of a lit curve.
void LeaveOutDeadSensors(IvCurve* curve) {
  const bool lit = IsZero(curve->irradiance_W_m2) && IsLit(*curve);
  for (const auto& [dead, about, column, why] :
       {std::tuple(IsZero(curve->temperature_C), About::kTemperature, &curve->temperature_C, ""),
        std::tuple(lit, About::kIrradiance, &curve->irradiance_W_m2, " beside a lit curve")}) {
    if (!dead) continue;
    column->clear();
    curve->assumptions.emplace_back(
        fmt::format("the column of the {} is 0 throughout{}, as without a sensor: not used",
                    ToText(about), why),
        about);
  }
}

}  // namespace

Expected<void> SettleTable(std::string_view text, const std::string& file, TableReading* reading) {
  TRY(TakeTrace(text, file, *reading, &reading->table));
  TakeUnitOfShortCircuit(&reading->table, reading->layout);
  NumberTables(reading);
  LeaveOutDeadSensors(&reading->table.curve);
  return {};
}

}  // namespace lyrefit
