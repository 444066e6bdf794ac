#include "lyrefit/read/column.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/column_names.h"
#include "lyrefit/read/label.h"

namespace lyrefit {
namespace {

// Unsupported units. They mark "voltage_percent" as a voltage with a wrong unit; "voltage_set" is
// no voltage.
constexpr std::string_view kForeignUnits[] = {"percent", "pct", "pu",  "w",         "mw", "kw",
                                              "ohm",     "db",  "f",   "degf",      "h",  "lux",
                                              "adc",     "raw", "bit", "fahrenheit"};

void TakeUnit(const Unit& unit, Column* column) {
  column->unit = unit.text;
  column->factor = unit.factor;
  column->offset = unit.offset;
}

bool IsPerArea(std::string_view unit) {
  return (unit.size() > 2 && unit.substr(unit.size() - 2) == "m2" && unit[0] != 'w');
}

void RefuseUnit(const std::string& unit, Column* column) {
  column->unit = unit;
  column->refusal = fmt::format("column {} is in {}: expected {}", Quoted(column->label),
                                Quoted(unit), ExpectedUnits(column->kind));
}

// Whether a word is the letter of the quantity before it, in front of a unit: the U of "Spannung U/V".
bool IsSymbolOf(ColumnKind kind, const std::vector<LabelWord>& words, std::size_t at) {
  if (at + 1 >= words.size() || words[at].marked_as_unit || !words[at + 1].marked_as_unit) {
    return false;
  }
  if (words[at].text == "e") return kind == ColumnKind::kIrradiance;
  if (words[at].text == "t") return kind == ColumnKind::kTemperature || kind == ColumnKind::kTime;
  const ColumnName* letter = words[at].text.size() == 1 ? FindName(words[at].text) : nullptr;
  return letter != nullptr &&
         (letter->kind == kind || (IsCurrent(letter->kind) && IsCurrent(kind)));
}

// Interprets the words after the name. False if they turn it into the name of another quantity.
bool TakeRest(const std::vector<LabelWord>& words, std::size_t from, Column* column) {
  if (IsSymbolOf(column->kind, words, from)) ++from;
  const std::string rest = JoinWords(words, from, words.size());
  if (rest.empty()) return true;
  const bool letter_and_unit = rest.size() == 2 && words.size() == from + 2 &&
                               !words[from].marked_as_unit && words[from + 1].marked_as_unit;
  if (letter_and_unit) return false;  // "V_d (V)" is no decivolt
  if (const Unit* unit = FindUnit(column->kind, rest)) {
    TakeUnit(*unit, column);
    return true;
  }
  if (column->kind == ColumnKind::kCurrent && IsPerArea(rest)) {
    column->kind = ColumnKind::kCurrentDensity;
    return TakeRest(words, from, column);
  }
  if (column->kind == ColumnKind::kSweep || column->kind == ColumnKind::kCurve) {
    return rest == "number" || rest == "index" || rest == "no" || rest == "id";
  }
  if (!IsAmong(kForeignUnits, rest) && !words[from].marked_as_unit) return false;
  RefuseUnit(rest, column);
  return true;
}

// The kind of a name of `count` words whose unit decides: a single T is a temperature and a single t
// a time, unless it is in seconds or degrees; J in ampere is a current; an intensity may be one of
// light or, in French and its neighbours, a current.
ColumnKind KindByUnit(const ColumnName& name, const std::vector<LabelWord>& words,
                      std::size_t count) {
  const std::string unit = JoinWords(words, count, words.size());
  const auto is_in = [&](ColumnKind kind) { return FindUnit(kind, unit) != nullptr; };
  if (name.text == "t") {
    if (is_in(ColumnKind::kTime)) return ColumnKind::kTime;
    if (is_in(ColumnKind::kTemperature)) return ColumnKind::kTemperature;
    return words[0].original == "T" ? ColumnKind::kTemperature : ColumnKind::kTime;
  }
  if (name.text == "j" && is_in(ColumnKind::kCurrent)) return ColumnKind::kCurrent;
  if (name.text == "amperage" && is_in(ColumnKind::kIrradiance)) return ColumnKind::kIrradiance;
  if (name.text != "intensity") return name.kind;
  const bool current = is_in(ColumnKind::kCurrent) || is_in(ColumnKind::kCurrentDensity);
  return current ? ColumnKind::kCurrent : name.kind;
}

// "Intensity" and "illuminance" denote an irradiance only if the unit confirms it.
bool IsVague(const Column& column, std::string_view name) {
  return (name == "intensity" || name == "illuminance") &&
         (column.unit.empty() || !column.refusal.empty());
}

// A current density without a unit is assumed in mA/cm2, the usual unit.
void SettleDensity(Column* column) {
  if (column->kind != ColumnKind::kCurrentDensity || !column->unit.empty()) return;
  column->factor = FindUnit(ColumnKind::kCurrentDensity, "macm2")->factor;
}

Column Recognise(std::string_view label, std::vector<LabelWord> words) {
  Column column;
  column.label = std::string(label);
  if (words.size() == 1) {
    if (const Unit* unit = FindUnitHeader(words[0].text)) {
      column.kind = unit->kind;
      TakeUnit(*unit, &column);
      return column;
    }
  }
  if (!words.empty()) CutQualifierOffLetter(&words.front());
  for (std::size_t count = words.size(); count > 0; --count) {
    const ColumnName* known = FindName(JoinWords(words, 0, count));
    if (known == nullptr) continue;
    column.kind = KindByUnit(*known, words, count);
    const bool named = TakeRest(words, count, &column) && !IsVague(column, known->text);
    if (!named) column.kind = ColumnKind::kUnrecognised;
    SettleDensity(&column);
    return column;
  }
  return column;
}

// The length of the longest unit of `kind` that begins at `from`, in words; 0: none.
std::size_t UnitLength(const std::vector<LabelWord>& words, std::size_t from, ColumnKind kind,
                       const Unit** unit) {
  for (std::size_t to = words.size(); to > from; --to) {
    *unit = FindUnit(kind, JoinWords(words, from, to));
    if (*unit != nullptr) return to - from;
  }
  return 0;
}

// Interprets a label whose words of direction and light were taken out. Name and unit come first,
// and what follows is the device: "Voltage (V) a". A label may also consist of a device and a unit:
// "b [mA/cm2]".
Column RecogniseTagged(std::string_view label, const std::vector<LabelWord>& words,
                       const ColumnTag& tag) {
  Column column = Recognise(label, words);
  column.tag = tag;
  if (IsElectrical(column.kind) && column.refusal.empty()) return column;
  const auto device = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      column.tag.device += (column.tag.device.empty() ? "" : " ") + words[i].original;
    }
  };
  const Unit* unit = nullptr;
  for (std::size_t count = words.size(); count > 0; --count) {
    const ColumnName* known = FindName(JoinWords(words, 0, count));
    if (known == nullptr || !IsElectrical(known->kind)) continue;
    for (const ColumnKind kind : {known->kind, ColumnKind::kCurrentDensity}) {
      if (kind != known->kind && known->kind != ColumnKind::kCurrent) continue;
      const std::size_t length = UnitLength(words, count, kind, &unit);
      if (length == 0) continue;
      column = {kind, std::string(label), {}, 1, 0, {}, tag};
      TakeUnit(*unit, &column);
      device(count + length, words.size());
      return column;
    }
  }
  for (std::size_t at = 0; at < words.size(); ++at) {
    if (!words[at].marked_as_unit) continue;
    for (const ColumnKind kind :
         {ColumnKind::kVoltage, ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
      if (at + UnitLength(words, at, kind, &unit) != words.size() || unit == nullptr) continue;
      column = {kind, std::string(label), {}, 1, 0, {}, tag};
      TakeUnit(*unit, &column);
      device(0, at);
      return column;
    }
    break;
  }
  column.kind = ColumnKind::kUnrecognised;
  return column;
}

// The light of a Suns-Voc trace, in suns, which takes the place of its current.
std::optional<Column> AsLightOfTrace(std::string_view label, const std::vector<LabelWord>& words,
                                     const ColumnTag& tag) {
  if (tag.light != SweepLight::kSunsVoc || words.empty()) return std::nullopt;
  Column column = Recognise(label, words);
  const bool irradiance = column.kind == ColumnKind::kIrradiance && column.refusal.empty();
  if (!irradiance && words[0].text != "suns") return std::nullopt;
  const double factor = irradiance ? column.factor / 1000 : 1;
  column = {ColumnKind::kCurrent, std::string(label), "a", factor, 0, {}, tag};
  column.light = true;
  return column;
}

Column RecogniseUnscaled(std::string_view label) {
  std::vector<LabelWord> words = SplitLabel(label);
  DropQualifiers(&words);
  Column column = Recognise(label, words);
  if (column.kind != ColumnKind::kUnrecognised && column.refusal.empty()) return column;
  const ColumnTag tag = TakeTag(&words);
  if (StatesSweep(tag) || tag.average) {
    if (const auto light = AsLightOfTrace(label, words, tag)) return *light;
    Column tagged = RecogniseTagged(label, words, tag);
    if (IsElectrical(tagged.kind)) return tagged;
  }
  const std::string number = TakeNumber(&words);
  if (number.empty()) return column;
  Column numbered = Recognise(label, words);
  if (!IsElectrical(numbered.kind)) return column;
  if (column.kind != ColumnKind::kUnrecognised && !numbered.refusal.empty()) return column;
  numbered.tag = tag;
  numbered.tag.device = number;
  return numbered;
}

}  // namespace

Column RecogniseColumn(std::string_view label) {
  const ScaledLabel scaled = TakeScale(label);
  if (scaled.scale == 1) return RecogniseUnscaled(label);
  Column column = RecogniseUnscaled(scaled.label);
  if (!IsElectrical(column.kind) || !column.refusal.empty()) return RecogniseUnscaled(label);
  column.label = std::string(label);
  column.factor *= scaled.scale;
  if (column.unit.empty()) column.unit = column.kind == ColumnKind::kVoltage ? "v" : "a";
  return column;
}

void Become(ColumnKind kind, const Unit* unit, Column* column) {
  Column made;
  made.kind = kind;
  made.label = std::move(column->label);
  if (unit != nullptr) TakeUnit(*unit, &made);
  SettleDensity(&made);
  *column = std::move(made);
}

Column ColumnSaidToBe(ColumnKind kind, std::string_view label) {
  Column column = RecogniseColumn(label);
  const bool as_said = column.kind == kind ||
                       (kind == ColumnKind::kCurrent && column.kind == ColumnKind::kCurrentDensity);
  if (as_said) return column;
  column = {};
  column.label = std::string(label);
  column.kind = kind;
  const ScaledLabel scaled = TakeScale(label);
  const std::vector<LabelWord> words = SplitLabel(scaled.label);
  for (std::size_t from = 0; from < words.size(); ++from) {
    const std::string unit = JoinWords(words, from, words.size());
    for (const ColumnKind as : {kind, ColumnKind::kCurrentDensity}) {
      if (as != kind && kind != ColumnKind::kCurrent) continue;
      const Unit* found = FindUnit(as, unit);
      // A single "A" may be a name as well as a unit.
      if (found == nullptr || (from == 0 && words.size() == 1)) continue;
      column.kind = as;
      TakeUnit(*found, &column);
      column.factor *= scaled.scale;
      return column;
    }
  }
  return column;
}

}  // namespace lyrefit
