#include "lyrefit/read/records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/read/join_sweeps.h"

namespace lyrefit {

void AddReading(std::string_view text, bool decimal_comma, int column, Record* list) {
  const auto number = ParseNumber(text, decimal_comma);
  if (number && std::fabs(*number) < kOverflowCode) return list->values.push_back(*number);
  const bool missing = IsMissingReading(text, decimal_comma) || (number && !std::isfinite(*number));
  // The number exceeds the range of a double, which is an overflow too.
  const bool overflow = !number && text.find_first_not_of("+-.0123456789eE") == std::string::npos &&
                        text.find_first_of("eE") != std::string::npos;
  const bool is_text = !missing && !overflow && text != "Infinity" && text != "-Infinity";
  if (!list->has_bad || (is_text && !list->bad_is_text)) {
    list->has_bad = true;
    list->bad = std::string(text);
    list->bad_at = list->values.size();
    list->bad_column = column;
    list->bad_is_text = is_text;
  }
  list->values.push_back(kUnknown);
}

namespace {

// The records of one channel while they are converted.
struct Reading {
  const Records& records;
  const std::vector<Column>& columns;
  const ReadOptions& options;
  const RecordPlace& place;
};

// The readings of a pair that are left out, since one of their values is missing.
Expected<std::vector<bool>> FindMissing(const Reading& reading, const ColumnPair& pair) {
  const Record& voltage = reading.records.lists[pair.voltage];
  const Record& current = reading.records.lists[pair.current];
  if (voltage.values.size() != current.values.size()) {
    return reading.place.Refuse(
        fmt::format("expected as many values in \"{}\" as in \"{}\", found {} and {}", current.name,
                    voltage.name, current.values.size(), voltage.values.size()),
        current.column);
  }
  std::vector<bool> missing(voltage.values.size(), false);
  for (const Record* list : {&voltage, &current}) {
    if (!list->has_bad) continue;
    if (!reading.options.skip_missing || list->bad_is_text) {
      return reading.place.Refuse(
          fmt::format("expected a finite number in \"{}\"[{}], found {}{}", list->name,
                      list->bad_at, list->bad.empty() ? "nothing" : Quoted(list->bad),
                      list->bad_is_text
                          ? ""
                          : ": if readings are missing, leave them out with --skip-missing"),
          list->bad_column, list->bad_line);
    }
    for (std::size_t i = 0; i < list->values.size(); ++i) {
      if (std::isnan(list->values[i])) missing[i] = true;
    }
  }
  return missing;
}

void TakeValues(const Reading& reading, const std::vector<bool>& missing, int place,
                std::vector<double>* values) {
  const std::vector<double>& list = reading.records.lists[place].values;
  const Column& column = reading.columns[place];
  values->reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!missing[i]) values->push_back(list[i] * column.factor + column.offset);
  }
}

// The destination of an optional column; nullptr for other columns.
std::vector<double>* TargetOf(ColumnKind kind, IvCurve* curve, std::vector<double>* sweep) {
  switch (kind) {
    case ColumnKind::kSigma:
      return &curve->sigma_A;
    case ColumnKind::kTime:
      return &curve->time_s;
    case ColumnKind::kSweep:
      return sweep;
    case ColumnKind::kIrradiance:
      return &curve->irradiance_W_m2;
    case ColumnKind::kTemperature:
      return &curve->temperature_C;
    default:
      return nullptr;
  }
}

void TakeFurtherLists(const Reading& reading, const std::vector<bool>& missing, IvCurve* curve) {
  std::vector<double> sweep;
  for (std::size_t i = 0; i < reading.columns.size(); ++i) {
    const Record& list = reading.records.lists[i];
    const bool usable =
        reading.columns[i].refusal.empty() && !list.has_bad && list.values.size() == missing.size();
    std::vector<double>* const target = TargetOf(reading.columns[i].kind, curve, &sweep);
    if (target == nullptr || !target->empty()) continue;
    if (usable) {
      TakeValues(reading, missing, static_cast<int>(i), target);
    } else if (!std::all_of(list.values.begin(), list.values.end(),
                            [](double value) { return std::isnan(value); })) {
      curve->assumptions.push_back(
          fmt::format("{} was not used: it has no number for every reading", Quoted(list.name)));
    }
  }
  for (const double number : sweep) curve->sweep.push_back(static_cast<int>(number));
}

Expected<void> CheckTemperatures(const RecordPlace& place, const IvCurve& curve) {
  for (const double value : curve.temperature_C) {
    if (value >= -100 && value <= 150) continue;
    return place.Refuse(
        fmt::format("expected temperatures in degrees Celsius from -100 to 150, found {:.6g}{}",
                    value, value > 150 ? ": looks like kelvin (name it temperature_K)" : ""));
  }
  return {};
}

void SayUnits(const Reading& reading, const ColumnPair& pair, IvCurve* curve) {
  const Column& voltage = reading.columns[pair.voltage];
  const Column& current = reading.columns[pair.current];
  curve->voltage_unit_known = !voltage.unit.empty();
  curve->current_unit_known = !current.unit.empty();
  // A packed row already has the assumption.
  if (!reading.records.assumptions.empty()) return;
  const bool density = current.kind == ColumnKind::kCurrentDensity;
  for (const auto& [column, unit] :
       {std::pair(&voltage, "V"), std::pair(&current, density ? "mA/cm2" : "A")}) {
    if (!column->unit.empty()) continue;
    curve->assumptions.push_back(
        fmt::format("{} names no unit: taken as {}", Quoted(column->label), unit));
  }
}

void SaySkipped(const std::vector<bool>& missing, IvCurve* curve) {
  const auto skipped = std::count(missing.begin(), missing.end(), true);
  if (skipped == 0) return;
  curve->assumptions.push_back(
      fmt::format("{} of {} rows without a reading left out", skipped, missing.size()));
}

}  // namespace

void SayPadding(std::size_t rows, IvCurve* curve) {
  if (rows == 0) return;
  curve->assumptions.push_back(
      fmt::format("{} of {} rows left out: they hold 0 V and 0 A at the end, where the sweep does "
                  "not come, and only pad the table",
                  rows, rows + curve->size()));
}

Expected<RawCurve> CurveOfRecords(const Records& records, const std::vector<Column>& columns,
                                  const Channel& channel, const ReadOptions& options,
                                  const RecordPlace& place) {
  const Reading reading{records, columns, options, place};
  TRY(const std::vector<bool> missing, FindMissing(reading, channel));
  RawCurve raw;
  IvCurve& curve = raw.curve;
  raw.per_area = columns[channel.current].kind == ColumnKind::kCurrentDensity;
  curve.assumptions.assign(records.assumptions.begin(), records.assumptions.end());
  SayUnits(reading, channel, &curve);
  SaySkipped(missing, &curve);
  TakeValues(reading, missing, channel.voltage, &curve.voltage_V);
  TakeValues(reading, missing, channel.current, &curve.current_A);
  TakeFurtherLists(reading, missing, &curve);
  TRY(CheckTemperatures(place, curve));
  std::size_t padding = LeaveOutPadding(0, &curve);
  std::vector<FurtherSweep> further;
  for (const ColumnPair& pair : channel.more) {
    TRY(const std::vector<bool> left_out, FindMissing(reading, pair));
    further.emplace_back();
    TakeValues(reading, left_out, pair.voltage, &further.back().curve.voltage_V);
    TakeValues(reading, left_out, pair.current, &further.back().curve.current_A);
    padding += LeaveOutPadding(0, &further.back().curve);
    SaySkipped(left_out, &curve);
  }
  SayPadding(padding, &curve);
  if (!further.empty()) curve.sweep.clear();
  std::vector<int> lines;
  JoinSweeps(columns, channel, std::move(further), &curve, &lines);
  TakeLight(columns[channel.current], &curve, &raw.stated);
  return raw;
}

}  // namespace lyrefit
