#include "lyrefit/curve/column.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lyrefit/curve/label.h"
#include "lyrefit/curve/number_text.h"

namespace lyrefit {
namespace {

struct Name {
  std::string_view text;  // letters and digits only, lower case
  ColumnKind kind;
};

constexpr Name kNames[] = {
    {"v", ColumnKind::kVoltage},
    {"u", ColumnKind::kVoltage},
    {"voltage", ColumnKind::kVoltage},
    {"voltages", ColumnKind::kVoltage},
    {"potential", ColumnKind::kVoltage},
    {"ewe", ColumnKind::kVoltage},  // working electrode
    {"vf", ColumnKind::kVoltage},   // "full", the measured voltage of potentiostats
    {"vm", ColumnKind::kVoltage},
    {"spannung", ColumnKind::kVoltage},
    {"tension", ColumnKind::kVoltage},
    {"tensione", ColumnKind::kVoltage},
    {"voltaje", ColumnKind::kVoltage},
    {"i", ColumnKind::kCurrent},
    {"im", ColumnKind::kCurrent},
    {"current", ColumnKind::kCurrent},
    {"currents", ColumnKind::kCurrent},
    {"strom", ColumnKind::kCurrent},
    {"stromst\u00e4rke", ColumnKind::kCurrent},
    {"courant", ColumnKind::kCurrent},
    {"corrente", ColumnKind::kCurrent},
    {"corriente", ColumnKind::kCurrent},
    {"sigma", ColumnKind::kSigma},
    {"sigmai", ColumnKind::kSigma},
    {"currentsigma", ColumnKind::kSigma},
    {"sigmacurrent", ColumnKind::kSigma},
    {"uncertainty", ColumnKind::kSigma},
    {"currentuncertainty", ColumnKind::kSigma},
    {"time", ColumnKind::kTime},
    {"elapsedtime", ColumnKind::kTime},
    {"t", ColumnKind::kTime},
    {"sweep", ColumnKind::kSweep},
    {"scan", ColumnKind::kSweep},
    {"curve", ColumnKind::kCurve},
    {"irradiance", ColumnKind::kIrradiance},
    {"irrad", ColumnKind::kIrradiance},
    {"intensity", ColumnKind::kIrradiance},
    {"g", ColumnKind::kIrradiance},
    {"poa", ColumnKind::kIrradiance},
    {"poairradiance", ColumnKind::kIrradiance},
    {"irradiancepoa", ColumnKind::kIrradiance},
    {"temperature", ColumnKind::kTemperature},
    {"temp", ColumnKind::kTemperature},
    {"tcell", ColumnKind::kTemperature},
    {"tmodule", ColumnKind::kTemperature},
    {"modt", ColumnKind::kTemperature},
    {"j", ColumnKind::kCurrentDensity},
    {"currentdensity", ColumnKind::kCurrentDensity},
};

// Words that say where a quantity was measured, not which one. A single letter may carry them:
// "Vmeas", "Idc".
constexpr std::string_view kQualifiers[] = {
    "pv",       "module", "cell", "panel",  "array", "string", "load",      "bias", "dut", "device",
    "measured", "meas",   "dc",   "output", "in",    "opc",    "electrode", "we",   "smu"};

// Unsupported units. They mark "voltage_percent" as a voltage with a wrong unit; "voltage_set" is
// no voltage.
constexpr std::string_view kForeignUnits[] = {"percent", "pct", "pu",  "w",         "mw", "kw",
                                              "ohm",     "db",  "f",   "degf",      "h",  "lux",
                                              "adc",     "raw", "bit", "fahrenheit"};

template <std::size_t N>
bool IsAmong(const std::string_view (&list)[N], std::string_view text) {
  return std::find(std::begin(list), std::end(list), text) != std::end(list);
}

bool IsDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

const Name* FindName(std::string_view text) {
  for (const Name& name : kNames) {
    if (name.text == text) return &name;
  }
  return nullptr;
}

bool IsElectrical(ColumnKind kind) {
  return kind == ColumnKind::kVoltage || kind == ColumnKind::kCurrent ||
         kind == ColumnKind::kCurrentDensity;
}

void DropQualifiers(std::vector<LabelWord>* words) {
  if (words->size() < 2) return;
  std::vector<LabelWord> kept;
  for (const LabelWord& word : *words) {
    if (!IsAmong(kQualifiers, word.text)) kept.push_back(word);
  }
  if (!kept.empty()) *words = kept;
}

// Shortens "vmeas" to "v", since "meas" is a qualifier.
void CutQualifierOffLetter(LabelWord* word) {
  if (word->text.size() < 3 || FindName(word->text) != nullptr) return;
  const Name* letter = FindName(word->text.substr(0, 1));
  if (letter == nullptr || !IsElectrical(letter->kind)) return;
  if (IsAmong(kQualifiers, std::string_view(word->text).substr(1))) word->text.resize(1);
}

// Removes the number of a pixel, channel or unit from the words and returns it: "I1", "Ch2
// voltage", "Current 1 (A)". The 2 of "mA cm-2" is not such a number.
std::string TakeNumber(std::vector<LabelWord>* words) {
  std::string number;
  const auto add = [&number](std::string_view digits) {
    if (!number.empty()) number += '.';
    number += digits;
  };
  std::vector<LabelWord> kept;
  for (LabelWord word : *words) {
    const bool of_a_unit = !kept.empty() && (kept.back().text == "cm" || kept.back().text == "m" ||
                                             kept.back().text == "mm");
    if (IsDigits(word.text) && !of_a_unit) {
      add(word.text);
      continue;
    }
    const std::size_t letters = word.text.find_last_not_of("0123456789") + 1;
    const std::string front = word.text.substr(0, letters);
    const bool channel = front == "ch" || front == "channel" || front == "px" || front == "pixel";
    const Name* name = FindName(front);
    const bool named = name != nullptr && IsElectrical(name->kind);
    if (letters < word.text.size() && (named || channel)) {
      add(std::string_view(word.text).substr(letters));
      word.text = front;
    }
    if (!channel) kept.push_back(word);
  }
  if (kept.empty()) return "";
  *words = kept;
  return number;
}

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

// Interprets the words after the name. False if they turn it into the name of another quantity.
bool TakeRest(const std::vector<LabelWord>& words, std::size_t from, Column* column) {
  const std::string rest = JoinWords(words, from, words.size());
  if (rest.empty()) return true;
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

// A single T is a temperature and a single t a time, unless the unit decides otherwise.
ColumnKind TimeOrTemperature(const std::vector<LabelWord>& words) {
  const std::string unit = JoinWords(words, 1, words.size());
  if (FindUnit(ColumnKind::kTime, unit) != nullptr) return ColumnKind::kTime;
  if (FindUnit(ColumnKind::kTemperature, unit) != nullptr) return ColumnKind::kTemperature;
  return words[0].original == "T" ? ColumnKind::kTemperature : ColumnKind::kTime;
}

// "Intensity" denotes an irradiance only if the unit confirms it.
bool IsVague(const Column& column, std::string_view name) {
  return name == "intensity" && (column.unit.empty() || !column.refusal.empty());
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
    const Name* known = FindName(JoinWords(words, 0, count));
    if (known == nullptr) continue;
    column.kind = known->text == "t" ? TimeOrTemperature(words) : known->kind;
    const bool named = TakeRest(words, count, &column) && !IsVague(column, known->text);
    if (!named) column.kind = ColumnKind::kUnrecognised;
    SettleDensity(&column);
    return column;
  }
  return column;
}

}  // namespace

Column RecogniseColumn(std::string_view label) {
  std::vector<LabelWord> words = SplitLabel(label);
  DropQualifiers(&words);
  Column column = Recognise(label, words);
  if (column.kind != ColumnKind::kUnrecognised) return column;
  const std::string number = TakeNumber(&words);
  if (number.empty()) return column;
  Column numbered = Recognise(label, words);
  if (!IsElectrical(numbered.kind)) return column;
  numbered.number = number;
  return numbered;
}

Column ColumnSaidToBe(ColumnKind kind, std::string_view label) {
  Column column = RecogniseColumn(label);
  const bool as_said = column.kind == kind ||
                       (kind == ColumnKind::kCurrent && column.kind == ColumnKind::kCurrentDensity);
  if (as_said) return column;
  column = {};
  column.label = std::string(label);
  column.kind = kind;
  const std::vector<LabelWord> words = SplitLabel(label);
  for (std::size_t from = 0; from < words.size(); ++from) {
    const std::string unit = JoinWords(words, from, words.size());
    for (const ColumnKind as : {kind, ColumnKind::kCurrentDensity}) {
      if (as != kind && kind != ColumnKind::kCurrent) continue;
      const Unit* found = FindUnit(as, unit);
      // A single "A" may be a name as well as a unit.
      if (found == nullptr || (from == 0 && words.size() == 1)) continue;
      column.kind = as;
      TakeUnit(*found, &column);
      return column;
    }
  }
  return column;
}

}  // namespace lyrefit
