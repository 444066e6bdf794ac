// Optimized fully: rows are parsed character by character.
#include "lyrefit/stream/row_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/guess_columns.h"
#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

// A row while it is converted to a curve.
struct RowReading {
  const Records& fields;
  const RecordPlace& place;
  const ReadOptions& options;
  std::vector<Column> columns;  // for each list
  Channel channel{-1, -1};
};

std::string NamesOf(const Records& fields) {
  constexpr std::size_t kShown = 12;
  std::string names;
  std::size_t count = 0;
  const auto add = [&](const std::string& name) {
    if (++count <= kShown) names += (names.empty() ? "" : ", ") + Quoted(name);
  };
  for (const Record& list : fields.lists) add(list.name);
  for (const RecordScalar& scalar : fields.scalars) add(scalar.name);
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
    if (IsElectrical(column.kind) && !column.refusal.empty())
      return reading.place.Refuse(column.refusal);
  }
  const bool current = has(ColumnKind::kCurrent) || has(ColumnKind::kCurrentDensity);
  const char* missing = "neither";
  if (has(ColumnKind::kVoltage)) missing = current ? "no clear pair" : "no current";
  if (current && !has(ColumnKind::kVoltage)) missing = "no voltage";
  return reading.place.Refuse(
      fmt::format("expected lists of voltage and current, such as voltage_V and current_A, found "
                  "{} among {}; name the columns with --voltage-column and --current-column",
                  missing, NamesOf(reading.fields)));
}

Expected<void> ChooseLists(RowReading* reading) {
  for (const Record& list : reading->fields.lists) {
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

// Adds irradiance or temperature from a column with any of their names.
Expected<void> TakeCondition(const RecordPlace& place, const RecordScalar& scalar,
                             const Column& column, double number, Sidecar* said) {
  const double value = number * column.factor + column.offset;
  const bool temperature = column.kind == ColumnKind::kTemperature;
  const bool fits = temperature ? value >= -100 && value <= 150 : value >= -kLargestDarkOffset_W_m2;
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
  if (target) return {};
  target = value;
  ConditionSources& in = said->stated_in;
  (temperature ? in.temperature : in.irradiance) = "\"" + scalar.name + "\"";
  return {};
}

bool IsCondition(const NameMeaning& meaning) {
  return meaning.column.refusal.empty() && (meaning.column.kind == ColumnKind::kIrradiance ||
                                            meaning.column.kind == ColumnKind::kTemperature);
}

// True if the field of a scalar is empty.
bool SaysNothing(const RecordScalar& scalar) {
  const std::string_view text = TrimBlanks(scalar.text);
  return text.empty() || text == "NaN" || text == "nan" || IsMissingWord(text);
}

// The conditions and notes of a row. Keys of a sidecar are read as in a sidecar file.
Expected<Sidecar> SidecarOfRow(const Records& fields, const RecordPlace& place) {
  nlohmann::json keys = nlohmann::json::object();
  Sidecar said;
  TableHead head;
  for (const RecordScalar& scalar : fields.scalars) {
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

Expected<IvCurve> CurveOfRow(const Records& fields, const RecordPlace& place, const std::string& id,
                             const ReadOptions& options) {
  for (const RecordScalar& scalar : fields.scalars) {
    if (scalar.name == "error") return place.Refuse(std::string(kPackedAsBroken) + scalar.text);
  }
  RowReading reading{fields, place, options, {}};
  TRY(ChooseLists(&reading));
  TRY(RawCurve raw, CurveOfRecords(fields, reading.columns, reading.channel, options, place));
  TRY(Sidecar stated, SidecarOfRow(fields, place));
  raw.stated = Merge(std::move(raw.stated), stated);
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

std::map<std::string, std::string> BesideOfRow(const Records& fields) {
  std::vector<bool> of_id;
  IdOf(fields.scalars, &of_id);
  std::map<std::string, std::string> beside;
  for (std::size_t i = 0; i < fields.scalars.size(); ++i) {
    const RecordScalar& scalar = fields.scalars[i];
    const NameMeaning& meaning = MeaningOf(scalar.name);
    const bool taken = of_id[i] || scalar.name == "error" || IsCondition(meaning) ||
                       (meaning.sidecar && scalar.name != "date");
    if (!taken && !SaysNothing(scalar)) beside.emplace(scalar.name, scalar.text);
  }
  return beside;
}

}  // namespace lyrefit
