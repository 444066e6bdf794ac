#include "lyrefit/read/table_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

#include "lyrefit/read/label.h"
#include "lyrefit/read/left_temperature.h"
#include "lyrefit/read/number_text.h"
#include "lyrefit/read/table_header.h"

namespace lyrefit {
namespace {

constexpr std::size_t kShownLines = 6;

// A statement: the words of its name, its unit and its value.
struct Statement {
  std::set<std::string> words;
  std::string name;  // the words, concatenated
  std::string unit;
  double value = 0;
};

bool HasAny(const Statement& statement, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return statement.words.count(word) != 0; });
}

// Whether the statement concerns another plane, a limit or a standard condition.
bool IsAboutOtherThings(const Statement& statement) {
  return HasAny(
      statement,
      {"ghi",       "dni",         "dhi",    "horizontal", "diffuse", "stc",     "noct",
       "reference", "ref",         "min",    "max",        "minimum", "maximum", "threshold",
       "target",    "coefficient", "alpha",  "beta",       "gamma",   "tempco",  "tolerance",
       "error",     "deviation",   "std",    "stdev",      "power",   "ambient", "air",
       "back",      "parallel",    "modules"});
}

std::optional<double> Converted(const Statement& statement, ColumnKind kind) {
  if (statement.unit.empty()) return std::nullopt;
  const Unit* unit = FindUnit(kind, statement.unit);
  if (unit == nullptr) return std::nullopt;
  return statement.value * unit->factor + unit->offset;
}

std::optional<double> AsIrradiance(const Statement& statement) {
  const bool named = HasAny(statement, {"irradiance", "irr", "irrad", "poa", "insolation",
                                        "einstrahlung", "irraggiamento", "eclairement", "intensity",
                                        "light", "g", "e", "sun", "suns", "pyranometer"}) ||
                     statement.name == "powerdensity";
  if (!named) return std::nullopt;
  auto value = Converted(statement, ColumnKind::kIrradiance);
  const bool in_suns = statement.name == "suns" || statement.name == "sun";
  if (in_suns && statement.unit.empty()) value = 1000 * statement.value;
  const bool plain = HasAny(statement, {"irradiance", "irr", "irrad", "poa", "einstrahlung"});
  if (!value && statement.unit.empty() && plain && statement.value >= 20) value = statement.value;
  if (!value || !(*value >= 0 && *value <= 1e5)) return std::nullopt;
  return value;
}

std::optional<double> AsTemperature(const Statement& statement) {
  static const std::set<std::string> kWhole = {"tc",
                                               "tcell",
                                               "tmod",
                                               "tmodule",
                                               "tpv",
                                               "temperature",
                                               "temp",
                                               "tmodul",
                                               "tzelle",
                                               "temperatur",
                                               "modultemp",
                                               "zelltemp",
                                               "celltemp",
                                               "modultemperatur",
                                               "zelltemperatur",
                                               "moduletemp",
                                               "zellentemperatur",
                                               "r\u00fcckseitentemperatur"};
  const bool whole = kWhole.count(statement.name) != 0;
  const bool temperature = HasAny(statement, {"temperature", "temp", "temperatur", "t"});
  const bool place =
      HasAny(statement, {"cell", "cells", "module", "mod", "pv", "panel", "device", "sample",
                         "zelle", "zellen", "solarzelle", "modul", "backsheet", "backside",
                         "r\u00fcckseite", "r\u00fcckseiten", "stage", "chuck"});
  if (!whole && !(temperature && place)) return std::nullopt;
  auto value = Converted(statement, ColumnKind::kTemperature);
  if (!value && statement.unit.empty()) value = statement.value;
  if (!value || !(*value >= -100 && *value <= 150)) return std::nullopt;
  return value;
}

std::optional<int> AsCells(const Statement& statement) {
  const bool count = HasAny(statement, {"number", "no", "num", "n", "count", "series", "in", "nr"});
  const bool named = statement.name == "cells" || statement.name == "ns" ||
                     statement.name == "ncells" || statement.name == "nscells" ||
                     (HasAny(statement, {"cells", "zellen"}) && count);
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 1 &&
                     statement.value <= 10000;
  if (!named || !whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

std::optional<int> AsBypassDiodes(const Statement& statement) {
  const bool named = HasAny(statement, {"bypass"}) && HasAny(statement, {"diodes", "dioden"});
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 0 &&
                     statement.value <= 1000;
  if (!named || !whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

std::optional<int> AsStrings(const Statement& statement) {
  const bool named = statement.name == "parallelstrings" || statement.name == "stringsinparallel";
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 1 &&
                     statement.value <= 10000;
  if (!named || !whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

std::optional<double> AsArea(const Statement& statement) {
  if (!HasAny(statement, {"area", "fl\u00e4che", "zellfl\u00e4che", "aperture"})) {
    return std::nullopt;
  }
  const auto value = Converted(statement, ColumnKind::kArea);
  if (!value || !(*value > 0)) return std::nullopt;
  return value;
}

// `area_cm2`: of the cell, for a limit per area.
std::optional<double> AsCompliance(const Statement& statement, std::optional<double> area_cm2) {
  const bool named = HasAny(statement, {"compliance"}) ||
                     (HasAny(statement, {"limit"}) && HasAny(statement, {"current", "i"}));
  if (!named) return std::nullopt;
  auto value = Converted(statement, ColumnKind::kCurrent);
  const auto density = Converted(statement, ColumnKind::kCurrentDensity);
  if (!value && density && area_cm2) value = *density * *area_cm2;
  if (!value || !(*value > 0)) return std::nullopt;
  return value;
}

// Records a value of a quantity that has none yet. False if there is no value or an earlier one.
template <class T>
bool TakeFirst(const std::optional<T>& value, const Assumption& what, const char* unit,
               const std::string& source, std::optional<T>* target, TableHead* head) {
  if (!value || *target) return false;
  *target = value;
  head->assumptions.emplace_back(fmt::format("{} {:.6g}{} taken from {}", what.sentence,
                                             static_cast<double>(*value), unit, source),
                                 what.about);
  return true;
}

// Records a value of a condition.
template <class T>
bool TakeFirst(const std::optional<T>& value, About about, const char* unit,
               const std::string& source, std::optional<T>* target, TableHead* head) {
  return TakeFirst(value, Assumption(ToText(about), about), unit, source, target, head);
}

// Keeps a stated Isc or Jsc for the unit of the current column. It does not count as understood,
// since the readings determine it better.
void NoteShortCircuit(const Statement& statement, const std::string& source, TableHead* head) {
  const bool named = statement.name == "isc" || statement.name == "jsc";
  if (!named || head->short_circuit || statement.value == 0) return;
  for (const ColumnKind kind : {ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
    const Unit* unit = FindUnit(kind, statement.unit);
    if (unit == nullptr) continue;
    head->short_circuit = {statement.value, kind, unit->factor, source};
  }
}

bool Take(const Statement& statement, const std::string& source, TableHead* head) {
  Sidecar* said = &head->said;
  NoteShortCircuit(statement, source, head);
  if (TakeFirst(AsCompliance(statement, said->notes.area_cm2), "compliance", " A", source,
                &said->notes.compliance_A, head)) {
    return true;
  }
  if (TakeFirst(AsStrings(statement), "strings in parallel", "", source, &said->strings_in_parallel,
                head)) {
    return true;
  }
  if (TakeFirst(AsBypassDiodes(statement), "bypass diodes", "", source, &said->notes.bypass_diodes,
                head)) {
    return true;
  }
  if (statement.name != "powerdensity" && IsAboutOtherThings(statement)) return false;
  return TakeFirst(AsIrradiance(statement), About::kIrradiance, " W/m2", source,
                   &said->irradiance_W_m2, head) ||
         TakeFirst(AsTemperature(statement), About::kTemperature, " C", source,
                   &said->temperature_C, head) ||
         TakeFirst(AsCells(statement), About::kCells, "", source, &said->cells_in_series, head) ||
         TakeFirst(AsArea(statement), "area", " cm2", source, &said->notes.area_cm2, head);
}

// Splits a label into name and unit. The unit is the longest end of the label that is a unit: "Cell
// area (cm2)", "area_cm2".
Statement Understand(const std::vector<LabelWord>& words, double value, std::string_view unit) {
  Statement statement;
  statement.value = value;
  std::size_t end = words.size();
  if (unit.empty()) {
    for (std::size_t from = 1; from < words.size() && end == words.size(); ++from) {
      const std::string text = JoinWords(words, from, words.size());
      for (const ColumnKind kind :
           {ColumnKind::kIrradiance, ColumnKind::kTemperature, ColumnKind::kArea,
            ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
        if (FindUnit(kind, text) != nullptr) end = from;
      }
      if (end == from) statement.unit = text;
    }
    for (std::size_t i = 0; i < end; ++i) {
      if (words[i].marked_as_unit) end = i;
    }
    if (statement.unit.empty()) statement.unit = JoinWords(words, end, words.size());
  } else {
    const std::vector<LabelWord> unit_words = SplitLabel(unit);
    statement.unit = JoinWords(unit_words, 0, unit_words.size());
  }
  statement.name = JoinWords(words, 0, end);
  for (std::size_t i = 0; i < end; ++i) statement.words.insert(words[i].text);
  return statement;
}

// Removes blanks, quotes and comment marks at the ends.
std::string_view TrimMarks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\"#%");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\"") - begin + 1);
}

// Number and unit of a text such as "47,3 C". Text with a second number, or with a word before the
// number, has none.
struct Quantity {
  double value;
  std::string_view unit;
};

std::optional<Quantity> AsQuantity(std::string_view text) {
  text = TrimMarks(text);
  const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
  if (const auto value = ParseNumber(text.substr(0, end), true)) {
    if (!std::isfinite(*value)) return std::nullopt;
    const std::string_view rest = TrimMarks(text.substr(end));
    const auto words = SplitFields(rest, ' ');
    const bool more =
        words && std::any_of(words->begin(), words->end(), [](const std::string& word) {
          return ParseNumber(word, true).has_value();
        });
    if (more) return std::nullopt;
    return Quantity{*value, rest};
  }
  // "25C"
  const std::size_t digits = text.find_first_not_of("+-.,0123456789");
  if (digits == 0 || digits == std::string_view::npos) return std::nullopt;
  const auto value = ParseNumber(text.substr(0, digits), true);
  const auto next = static_cast<unsigned char>(text[digits]);
  const bool unit = next >= 0x80 || next == '%' || std::isalpha(next) != 0;
  if (!value || !unit) return std::nullopt;
  return Quantity{*value, text.substr(digits)};
}

// The quantities of a list such as "[0.16, 0.16]"; none if the text is no list.
std::vector<Quantity> AsList(std::string_view text) {
  text = TrimMarks(text);
  std::vector<Quantity> list;
  if (text.size() < 3 || text.front() != '[' || text.back() != ']') return list;
  const auto items = SplitFields(text.substr(1, text.size() - 2), ',');
  if (!items) return list;
  for (const std::string& item : *items) {
    const auto value = ParseNumber(item);
    if (!value || !std::isfinite(*value)) return {};
    list.push_back({*value, {}});
  }
  return list;
}

// Result of reading one line, or the field of a line between two delimiters.
struct HeadLineState {
  const std::string& source;
  TableHead* head;
  bool understood = false;
  bool holds_number = false;
};

void TakeQuantity(HeadLineState* state, std::string_view label, const Quantity& quantity) {
  state->holds_number = true;
  const Statement statement = Understand(SplitLabel(label), quantity.value, quantity.unit);
  state->understood = Take(statement, state->source, state->head) || state->understood;
}

bool IsDate(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  return !words.empty() && words.size() <= 2 &&
         (words[0].text == "date" || words[0].text == "datum");
}

void TakeDate(HeadLineState* state, std::string_view text) {
  const std::string_view date = TrimMarks(text);
  constexpr std::size_t kLongest = 40;
  if (!state->head->said.notes.date.empty() || date.size() > kLongest) return;
  if (date.find_first_of("0123456789") == std::string_view::npos) return;
  state->head->said.notes.date = std::string(date);
  state->understood = true;
}

// Whether a line that was not understood may state the temperature of the device: a word of its label
// names one, and none another thing.
bool MayStateTemperature(std::string_view label) {
  Statement statement;
  bool named = false;
  for (const LabelWord& word : SplitLabel(label)) {
    named = named || word.text.find("temp") != std::string::npos;
    statement.words.insert(word.text);
  }
  return named && !IsAboutOtherThings(statement) &&
         !HasAny(statement, {"umgebung", "umgebungstemperatur", "lufttemperatur", "luft", "room",
                             "raumtemperatur", "coeff", "koeffizient", "temperaturkoeffizient"});
}

// Reads a statement such as "Label: 47.3 C" or "Label = 47.3".
bool ReadPart(HeadLineState* state, std::string_view text) {
  const std::size_t at = text.find_first_of(":=");
  if (at == std::string_view::npos || at == 0) return false;
  const std::string_view value = TrimMarks(text.substr(at + 1));
  if (value.empty()) return false;
  if (IsDate(text.substr(0, at))) {
    TakeDate(state, value);
    return true;
  }
  const auto quantity = AsQuantity(value);
  if (quantity) TakeQuantity(state, text.substr(0, at), *quantity);
  return quantity.has_value();
}

void ReadFields(HeadLineState* state, const Fields& fields) {
  std::string label;
  std::vector<Quantity> quantities;
  bool parts = false;
  for (const std::string& field : fields) {
    if (ReadPart(state, field)) {
      parts = true;
    } else if (const auto quantity = AsQuantity(field)) {
      quantities.push_back(*quantity);
    } else if (const auto list = AsList(field); !list.empty()) {
      quantities.insert(quantities.end(), list.begin(), list.end());
    } else {
      if (IsDate(label) && quantities.empty()) TakeDate(state, field);
      label += (label.empty() ? "" : " ") + field;
    }
  }
  if (parts && quantities.empty()) return;
  // A value for each of several pixels counts if all are equal.
  const bool equal = std::all_of(quantities.begin(), quantities.end(), [&](const Quantity& other) {
    return other.value == quantities[0].value && other.unit == quantities[0].unit;
  });
  // The unit may be in a separate field: "Irradiance;912;W/m2". The label then contains it.
  if (!quantities.empty() && equal) TakeQuantity(state, label, quantities[0]);
  if (quantities.size() > 1) state->holds_number = true;
}

// Reads one number between words, "POA 912 W/m2".
void ReadWords(HeadLineState* state, std::string_view text) {
  const auto words = SplitFields(text, ' ');
  if (!words) return;
  std::size_t numbers = 0;
  std::size_t place = 0;
  for (std::size_t i = 0; i < words->size(); ++i) {
    if (!ParseNumber((*words)[i], true)) continue;
    ++numbers;
    place = i;
  }
  state->holds_number = state->holds_number || numbers > 0;
  if (numbers != 1 || place == 0) return;
  std::string label;
  std::string rest;
  for (std::size_t i = 0; i < words->size(); ++i) {
    if (i != place) (i < place ? label : rest) += (*words)[i] + " ";
  }
  TakeQuantity(state, label, {*ParseNumber((*words)[place], true), TrimMarks(rest)});
}

// Whether all that follows "Label:" is one number and its unit: the comma of "Label: 47,3 C" is decimal.
bool HoldsOneQuantity(std::string_view line) {
  const std::size_t at = line.find_first_of(":=");
  return at != std::string_view::npos && AsQuantity(line.substr(at + 1)).has_value();
}

void ReadLine(HeadLineState* state, std::string_view line) {
  for (const char delimiter : {'\t', ';', ','}) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields || fields->size() < 2) continue;
    if (delimiter == ',' && HoldsOneQuantity(line)) break;
    return ReadFields(state, *fields);
  }
  if (!ReadPart(state, line)) ReadWords(state, line);
}

}  // namespace

void ReadHeadLine(std::string_view line, int number, HeadLine kind, TableHead* head) {
  constexpr std::size_t kLongestLine = 1000;
  if (line.size() > kLongestLine) return;  // too long for a statement
  const std::string source = fmt::format("line {} {}", number, Quoted(TrimMarks(line)));
  HeadLineState state{source, head};
  ReadLine(&state, TrimMarks(line));
  if (!state.holds_number) TakeColumnNames(line, &head->column_names);
  if (!state.holds_number || state.understood) return;
  const std::string_view label = line.substr(0, line.find_first_of(":=\t;,"));
  if (MayStateTemperature(TrimMarks(label))) head->left_temperatures.push_back(source);
  if (kind == HeadLine::kText) {
    const bool is_result = IsResult(label);
    (is_result ? head->results : head->left).push_back(source);
    if (is_result) {
      head->result_lines.push_back(ReadResultLine(line, head->column_names, source));
    }
  }
}

bool TakeStatement(std::string_view label, double value, const std::string& source,
                   TableHead* head) {
  return Take(Understand(SplitLabel(label), value, ""), source, head);
}

std::vector<Assumption> HeadSentences(const TableHead& head) {
  std::vector<Assumption> sentences = head.assumptions;
  if (!head.said.temperature_C && !head.left_temperatures.empty()) {
    sentences.push_back(LeftTemperature(head.left_temperatures.front()));
  }
  for (const auto& [what, lines] :
       {std::pair("stated key points and results, not used in a fit: ", &head.results),
        std::pair("not understood, and not used: ", &head.left)}) {
    std::string list;
    for (std::size_t i = 0; i < lines->size() && i < kShownLines; ++i) {
      list += (i == 0 ? "" : ", ") + (*lines)[i];
    }
    if (lines->size() > kShownLines)
      list += fmt::format(" and {} more", lines->size() - kShownLines);
    if (!list.empty()) sentences.emplace_back(what + list);
  }
  return sentences;
}

}  // namespace lyrefit
