#include "lyrefit/batch/row_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/try.h"
#include "lyrefit/batch/row_names.h"
#include "lyrefit/curve/current_sign.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/select_sweep.h"
#include "lyrefit/curve/sidecar.h"
#include "lyrefit/curve/table_columns.h"
#include "lyrefit/curve/table_curve.h"
#include "lyrefit/curve/table_head.h"

namespace lyrefit {
namespace {

// A row while it is converted to a curve.
struct RowReading {
  const RowFields& fields;
  const RowPlace& place;
  const ReadOptions& options;
  std::vector<Column> columns;  // for each list
  Channel channel{-1, -1};
  std::vector<bool> missing;  // true: the point is left out
};

std::string NamesOf(const RowFields& fields) {
  constexpr std::size_t kShown = 12;
  std::string names;
  std::size_t count = 0;
  const auto add = [&](const std::string& name) {
    if (++count <= kShown) names += (names.empty() ? "" : ", ") + Quoted(name);
  };
  for (const RowList& list : fields.lists) add(list.name);
  for (const RowScalar& scalar : fields.scalars) add(scalar.name);
  if (names.empty()) return "nothing";
  return count > kShown ? names + ", ..." : names;
}

// The error that explains why the lists hold no voltage and current.
tl::unexpected<Error> RefuseNames(const RowReading& reading) {
  const auto has = [&](ColumnKind kind) {
    return std::any_of(reading.columns.begin(), reading.columns.end(), [&](const Column& column) {
      return column.kind == kind && column.refusal.empty();
    });
  };
  for (const Column& column : reading.columns) {
    const bool wanted = column.kind == ColumnKind::kVoltage ||
                        column.kind == ColumnKind::kCurrent ||
                        column.kind == ColumnKind::kCurrentDensity;
    if (wanted && !column.refusal.empty()) return reading.place.Refuse(column.refusal);
  }
  const bool current = has(ColumnKind::kCurrent) || has(ColumnKind::kCurrentDensity);
  const char* missing = "neither";
  if (has(ColumnKind::kVoltage)) missing = current ? "no clear pair" : "no current";
  if (current && !has(ColumnKind::kVoltage)) missing = "no voltage";
  return reading.place.Refuse(
      fmt::format("expected lists of voltage and current, such as voltage_V and current_A, found "
                  "{} among {}",
                  missing, NamesOf(reading.fields)));
}

Expected<void> ChooseLists(RowReading* reading) {
  for (const RowList& list : reading->fields.lists) {
    reading->columns.push_back(MeaningOf(list.name).column);
  }
  ApplyColumnWishes(reading->options, &reading->columns);
  std::vector<Channel> channels = FindChannels(reading->columns);
  if (channels.empty() && GuessColumns(&reading->columns)) {
    channels = FindChannels(reading->columns);
  }
  if (channels.empty()) return RefuseNames(*reading);
  const auto chosen = ChooseChannel(reading->columns, channels, reading->options.column);
  if (!chosen) return reading->place.Refuse(chosen.error().message);
  reading->channel = *chosen;
  const auto units = ApplyUnitWishes(reading->options, *chosen, &reading->columns);
  if (!units) return reading->place.Refuse(units.error().message);
  return {};
}

Expected<void> CheckLists(RowReading* reading) {
  const RowList& voltage = reading->fields.lists[reading->channel.voltage];
  const RowList& current = reading->fields.lists[reading->channel.current];
  if (voltage.values.size() != current.values.size()) {
    return reading->place.Refuse(
        fmt::format("expected as many values in \"{}\" as in \"{}\", found {} and {}", current.name,
                    voltage.name, current.values.size(), voltage.values.size()),
        current.column);
  }
  reading->missing.assign(voltage.values.size(), false);
  for (const RowList* list : {&voltage, &current}) {
    if (list->bad_column == 0) continue;
    if (!reading->options.skip_missing || list->bad_is_text) {
      return reading->place.Refuse(
          fmt::format("expected a finite number in \"{}\"[{}], found {}{}", list->name,
                      list->bad_at, list->bad.empty() ? "nothing" : Quoted(list->bad),
                      list->bad_is_text
                          ? ""
                          : ": if readings are missing, leave them out with --skip-missing"),
          list->bad_column, list->bad_line);
    }
    for (std::size_t i = 0; i < list->values.size(); ++i) {
      if (std::isnan(list->values[i])) reading->missing[i] = true;
    }
  }
  return {};
}

void TakeValues(const RowReading& reading, int place, std::vector<double>* values) {
  const std::vector<double>& list = reading.fields.lists[place].values;
  const Column& column = reading.columns[place];
  values->reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!reading.missing[i]) values->push_back(list[i] * column.factor + column.offset);
  }
}

void TakeFurtherLists(const RowReading& reading, IvCurve* curve) {
  std::vector<double> sweep;
  for (std::size_t i = 0; i < reading.columns.size(); ++i) {
    const RowList& list = reading.fields.lists[i];
    const bool usable = reading.columns[i].refusal.empty() && list.bad_column == 0 &&
                        list.values.size() == reading.missing.size();
    std::vector<double>* target = nullptr;
    switch (reading.columns[i].kind) {
      case ColumnKind::kSigma:
        target = &curve->sigma_A;
        break;
      case ColumnKind::kTime:
        target = &curve->time_s;
        break;
      case ColumnKind::kSweep:
        target = &sweep;
        break;
      case ColumnKind::kIrradiance:
        target = &curve->irradiance_W_m2;
        break;
      case ColumnKind::kTemperature:
        target = &curve->temperature_C;
        break;
      default:
        break;
    }
    if (target == nullptr || !target->empty()) continue;
    if (usable) {
      TakeValues(reading, static_cast<int>(i), target);
    } else if (!std::all_of(list.values.begin(), list.values.end(),
                            [](double value) { return std::isnan(value); })) {
      curve->assumptions.push_back(
          fmt::format("{} was not used: it has no number for every reading", Quoted(list.name)));
    }
  }
  for (const double number : sweep) curve->sweep.push_back(static_cast<int>(number));
}

Expected<void> CheckTemperatures(const RowPlace& place, const IvCurve& curve) {
  for (const double value : curve.temperature_C) {
    if (value >= -100 && value <= 150) continue;
    return place.Refuse(
        fmt::format("expected temperatures in degrees Celsius from -100 to 150, found {:.6g}{}",
                    value, value > 150 ? ": looks like kelvin (name it temperature_K)" : ""));
  }
  return {};
}

void SayWhatWasAssumed(const RowReading& reading, IvCurve* curve) {
  curve->assumptions.assign(reading.fields.assumptions.begin(), reading.fields.assumptions.end());
  const Column& voltage = reading.columns[reading.channel.voltage];
  const Column& current = reading.columns[reading.channel.current];
  curve->voltage_unit_known = !voltage.unit.empty();
  curve->current_unit_known = !current.unit.empty();
  const bool density = current.kind == ColumnKind::kCurrentDensity;
  // A packed row already has the assumption.
  const bool packed = !reading.fields.assumptions.empty();
  for (const auto& [column, unit] :
       {std::pair(&voltage, "V"), std::pair(&current, density ? "mA/cm2" : "A")}) {
    if (packed || !column->unit.empty()) continue;
    curve->assumptions.push_back(
        fmt::format("{} names no unit: taken as {}", Quoted(column->label), unit));
  }
  const auto skipped = std::count(reading.missing.begin(), reading.missing.end(), true);
  if (skipped == 0) return;
  curve->assumptions.push_back(
      fmt::format("{} of {} rows without a reading left out", skipped, reading.missing.size()));
}

// Adds irradiance or temperature from a column with any of their names.
Expected<void> TakeCondition(const RowPlace& place, const RowScalar& scalar, const Column& column,
                             double number, Sidecar* said) {
  const double value = number * column.factor + column.offset;
  const bool temperature = column.kind == ColumnKind::kTemperature;
  const bool fits = temperature ? value >= -100 && value <= 150 : value >= 0;
  if (!fits || !std::isfinite(value)) {
    return place.Refuse(
        fmt::format("expected {} in \"{}\", found {}",
                    temperature ? value > 150 ? "degrees Celsius from -100 to 150 (it looks like "
                                                "kelvin: name it temperature_K)"
                                              : "degrees Celsius from -100 to 150"
                                : "W/m2 from 0 up",
                    scalar.name, Quoted(scalar.text)),
        scalar.column);
  }
  std::optional<double>& target = temperature ? said->temperature_C : said->irradiance_W_m2;
  if (!target) target = value;
  return {};
}

bool IsCondition(const NameMeaning& meaning) {
  return meaning.column.refusal.empty() && (meaning.column.kind == ColumnKind::kIrradiance ||
                                            meaning.column.kind == ColumnKind::kTemperature);
}

// True if the field of a scalar is empty.
bool SaysNothing(const RowScalar& scalar) {
  const std::string_view text = TrimBlanks(scalar.text);
  return text.empty() || text == "NaN" || text == "nan" || IsMissingWord(text);
}

// The conditions and notes of a row. Keys of a sidecar are read as in a sidecar file.
Expected<Sidecar> SidecarOfRow(const RowFields& fields, const RowPlace& place) {
  nlohmann::json keys = nlohmann::json::object();
  Sidecar said;
  TableHead head;
  for (const RowScalar& scalar : fields.scalars) {
    if (SaysNothing(scalar)) continue;
    const NameMeaning& meaning = MeaningOf(scalar.name);
    const auto number = ParseNumber(scalar.text);
    if (meaning.sidecar) {
      const bool as_text = !number || scalar.name == "date" || scalar.name == "technology";
      nlohmann::json& target =
          meaning.noise == nullptr ? keys[scalar.name] : keys["current_noise"][meaning.noise];
      target = as_text ? nlohmann::json(scalar.text) : nlohmann::json(*number);
    } else if (IsCondition(meaning)) {
      if (!number) {
        return place.Refuse(
            fmt::format("expected a number in \"{}\", found {}", scalar.name, Quoted(scalar.text)),
            scalar.column);
      }
      TRY(TakeCondition(place, scalar, meaning.column, *number, &said));
    } else if (meaning.states && number && std::isfinite(*number)) {
      TakeStatement(scalar.name, *number, Quoted(scalar.name), &head);
    }
  }
  head.said.assumptions = HeadSentences(head);
  said = Merge(std::move(said), head.said);
  if (keys.empty()) return said;
  auto stated = SidecarOfKeys(keys, place.file);
  if (!stated) return place.Refuse(stated.error().message);
  return Merge(std::move(*stated), said);
}

// Removes duplicates: an assumption of a packed curve may be made again.
void SayOnce(std::vector<Assumption>* assumptions) {
  std::vector<Assumption> kept;
  for (Assumption& one : *assumptions) {
    const bool said = std::any_of(kept.begin(), kept.end(), [&](const Assumption& other) {
      return other.sentence == one.sentence;
    });
    if (!said) kept.push_back(std::move(one));
  }
  *assumptions = std::move(kept);
}

}  // namespace

Expected<IvCurve> CurveOfRow(const RowFields& fields, const RowPlace& place, const std::string& id,
                             const ReadOptions& options) {
  for (const RowScalar& scalar : fields.scalars) {
    if (scalar.name == "error") return place.Refuse(std::string(kPackedAsBroken) + scalar.text);
  }
  RowReading reading{fields, place, options, {}, {-1, -1}, {}};
  TRY(ChooseLists(&reading));
  TRY(CheckLists(&reading));
  RawCurve raw;
  raw.per_area = reading.columns[reading.channel.current].kind == ColumnKind::kCurrentDensity;
  SayWhatWasAssumed(reading, &raw.curve);
  TakeValues(reading, reading.channel.voltage, &raw.curve.voltage_V);
  TakeValues(reading, reading.channel.current, &raw.curve.current_A);
  TakeFurtherLists(reading, &raw.curve);
  TRY(CheckTemperatures(place, raw.curve));
  TRY(raw.stated, SidecarOfRow(fields, place));
  raw.curve.name = id;
  raw.curve.source = place.file;
  if (auto selected = SelectSweep(options.curve, false, &raw.curve); !selected) {
    return place.Refuse(selected.error().message);
  }
  TurnLoadSign(&raw.curve);
  auto curve = FinishCurve(std::move(raw), options);
  if (!curve) return place.Refuse(curve.error().message);
  SayOnce(&curve->assumptions);
  return curve;
}

std::map<std::string, std::string> BesideOfRow(const RowFields& fields) {
  std::vector<bool> of_id;
  IdOf(fields.scalars, &of_id);
  std::map<std::string, std::string> beside;
  for (std::size_t i = 0; i < fields.scalars.size(); ++i) {
    const RowScalar& scalar = fields.scalars[i];
    const NameMeaning& meaning = MeaningOf(scalar.name);
    const bool taken = of_id[i] || scalar.name == "error" || IsCondition(meaning) ||
                       (meaning.sidecar && scalar.name != "date");
    if (!taken && !SaysNothing(scalar)) beside.emplace(scalar.name, scalar.text);
  }
  return beside;
}

}  // namespace lyrefit
