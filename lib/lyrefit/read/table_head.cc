#include "lyrefit/read/table_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

constexpr std::size_t kShownLines = 6;

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

// A unit without the remark in brackets behind it: "lux (LED 3000 K)".
std::string_view WithoutRemark(std::string_view unit) {
  const std::size_t begin = unit.find_first_not_of(" \t\"");
  if (begin == std::string_view::npos) return {};
  unit.remove_prefix(begin);
  const std::size_t bracket = unit.find('(');
  if (bracket != std::string_view::npos && bracket > 0) unit = unit.substr(0, bracket);
  return unit.substr(0, unit.find_last_not_of(" \t\"") + 1);
}

std::optional<Quantity> AsQuantity(std::string_view text) {
  text = TrimMarks(text);
  const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
  if (const auto value = ParseNumber(text.substr(0, end), true)) {
    if (!std::isfinite(*value)) return std::nullopt;
    const std::string_view rest = WithoutRemark(text.substr(end));
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
  std::optional<Statement> bare_temperature;  // "T = 50.2 C"
};

void TakeQuantity(HeadLineState* state, std::string_view label, const Quantity& quantity) {
  state->holds_number = true;
  const Statement statement = Understand(SplitLabel(label), quantity.value, quantity.unit);
  state->understood = TakeStatement(statement, state->source, state->head) || state->understood;
  if (IsBareTemperature(statement)) state->bare_temperature = statement;
}

// Takes "20 modules": what is counted stands behind its number. False if it is no such count.
bool TakeCount(HeadLineState* state, const Quantity& quantity) {
  Statement statement = Understand(SplitLabel(quantity.unit), quantity.value, "");
  const bool counts = HasAny(statement, {"cells", "diodes", "module", "modules"});
  statement.words.insert({"number", "of"});
  if (!counts || !TakeStatement(statement, state->source, state->head)) return false;
  return state->holds_number = state->understood = true;
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

bool IsTechnology(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  const std::string name = JoinWords(words, 0, words.size());
  for (const char* const known :
       {"technology", "celltechnology", "moduletechnology", "pvtechnology", "celltype",
        "typeofcell", "material", "cellmaterial", "absorber", "technologie", "zelltechnologie",
        "zelltyp"}) {
    if (name == known) return true;
  }
  return false;
}

void TakeTechnology(HeadLineState* state, std::string_view text) {
  std::string& technology = state->head->said.notes.technology;
  const std::string value(TrimMarks(text));
  if (!technology.empty() || FindTechnology(value) == nullptr) return;
  technology = value;
  state->understood = true;
  state->head->assumptions.emplace_back(
      fmt::format("technology {} taken from {}", value, state->source), About::kTechnology);
  state->head->said.stated_in.technology = PlaceOf(state->source);
}

void TakeLight(HeadLineState* state, std::string_view text) {
  const std::string words = "light " + std::string(TrimMarks(text));  // "off"
  state->understood = TakeLight(words, state->source, state->head) || state->understood;
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
  if (IsTechnology(text.substr(0, at))) TakeTechnology(state, value);
  if (NamesLight(text.substr(0, at))) TakeLight(state, value);
  const auto quantity = AsQuantity(value);
  if (quantity) TakeQuantity(state, text.substr(0, at), *quantity);
  return quantity.has_value();
}

// Reads one number between words, "POA 912 W/m2". False if nothing was understood.
bool ReadWords(HeadLineState* state, std::string_view text) {
  const auto words = SplitFields(text, ' ');
  if (!words) return false;
  std::size_t numbers = 0;
  std::size_t place = 0;
  for (std::size_t i = 0; i < words->size(); ++i) {
    if (!ParseNumber((*words)[i], true)) continue;
    ++numbers;
    place = i;
  }
  state->holds_number = state->holds_number || numbers > 0;
  if (numbers != 1 || place == 0) return false;
  std::string label;
  std::string rest;
  for (std::size_t i = 0; i < words->size(); ++i) {
    if (i != place) (i < place ? label : rest) += (*words)[i] + " ";
  }
  const bool before = std::exchange(state->understood, false);
  TakeQuantity(state, label, {*ParseNumber((*words)[place], true), TrimMarks(rest)});
  return std::exchange(state->understood, state->understood || before);
}

// Reads a field that is a whole statement, "POA 912 W/m2". False if it is none.
bool ReadStatement(HeadLineState* state, std::string_view field) {
  const bool before = state->holds_number;
  const bool understood = ReadWords(state, field);
  if (!understood) state->holds_number = before;
  return understood;
}

void ReadFields(HeadLineState* state, const Fields& fields) {
  std::string label;
  std::vector<Quantity> quantities;
  bool parts = false;
  for (const std::string& field : fields) {
    if (ReadPart(state, field)) {
      parts = true;
    } else if (const auto quantity = AsQuantity(field)) {
      if (!TakeCount(state, *quantity)) quantities.push_back(*quantity);
    } else if (const auto list = AsList(field); !list.empty()) {
      quantities.insert(quantities.end(), list.begin(), list.end());
    } else if (!ReadStatement(state, field)) {
      if (IsDate(label) && quantities.empty()) TakeDate(state, field);
      if (IsTechnology(label) && quantities.empty()) TakeTechnology(state, field);
      if (NamesLight(label) && quantities.empty()) TakeLight(state, field);
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

// Whether all that follows "Label:" is one number and its unit: the comma of "Label: 47,3 C" is decimal.
bool HoldsOneQuantity(std::string_view line) {
  const std::size_t at = line.find_first_of(":=");
  return at != std::string_view::npos && AsQuantity(line.substr(at + 1)).has_value();
}

void ReadLine(HeadLineState* state, std::string_view line) {
  for (const char delimiter : kFieldMarks) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields || fields->size() < 2) continue;
    if (delimiter == ',' && HoldsOneQuantity(line)) break;
    return ReadFields(state, *fields);
  }
  const auto count = AsQuantity(line);
  if (ReadPart(state, line) || (count && TakeCount(state, *count))) return;
  ReadWords(state, line);
}

}  // namespace

void ReadHeadLine(std::string_view text, int number, HeadLine kind, TableHead* head) {
  constexpr std::size_t kLongestLine = 1000;
  if (text.size() > kLongestLine) return;  // too long for a statement
  const std::string half_width = HalfWidth(text);
  const std::string_view line = half_width;
  const std::string source = fmt::format("line {} {}", number, Quoted(TrimMarks(line)));
  HeadLineState state{source, head, false, false, {}};
  ReadLine(&state, TrimMarks(line));
  TakeSetup(FindSetup(std::string(line)), PlaceOf(source), &head->said);
  if (state.bare_temperature && TakeTemperatureBesideLight(*state.bare_temperature, source, head)) {
    state.understood = true;
  }
  if (!state.holds_number) TakeColumnNames(line, &head->column_names);
  if (!state.holds_number || state.understood) return;
  const std::string_view label = line.substr(0, line.find_first_of(":=\t;,|"));
  if (MayStateTemperature(TrimMarks(label))) head->left_temperatures.push_back(source);
  if (kind == HeadLine::kText) {
    const bool is_result = IsResult(label);
    (is_result ? head->results : head->left).push_back(source);
    if (is_result) {
      head->result_lines.push_back(ReadResultLine(line, head->column_names, source));
    }
  }
}

bool TakeLight(std::string_view words, const std::string& source, TableHead* head) {
  constexpr double kBrightRoom_W_m2 = 100;  // no room but a greenhouse has more
  std::optional<double>& irradiance = head->said.irradiance_W_m2;
  const bool dark = ReadTag(words).light == SweepLight::kDark;
  if (!dark && !IsRoomLight(words)) return false;
  if (!dark && irradiance && *irradiance < kBrightRoom_W_m2) return true;
  Forget(About::kIrradiance, &head->assumptions);
  if (irradiance && *irradiance > 0) {
    head->assumptions.emplace_back(
        fmt::format("irradiance of {:.6g} W/m2 not used, since {} states other light", *irradiance,
                    source),
        About::kIrradiance);
  }
  irradiance.reset();
  if (dark) {
    irradiance = 0;
    head->assumptions.emplace_back("irradiance 0 W/m2, since " + source + " is dark",
                                   About::kIrradiance);
  } else {
    head->said.light = source;
  }
  return true;
}

bool TakeStatement(std::string_view label, double value, const std::string& source,
                   TableHead* head) {
  return TakeStatement(Understand(SplitLabel(label), value, ""), source, head);
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
