#include "lyrefit/read/column_names.h"

#include <optional>
#include <utility>

#include "lyrefit/base/number_text.h"

namespace lyrefit {
namespace {

constexpr ColumnName kNames[] = {
    {"v", ColumnKind::kVoltage},
    {"u", ColumnKind::kVoltage},
    {"voltage", ColumnKind::kVoltage},
    {"voltages", ColumnKind::kVoltage},
    {"potential", ColumnKind::kVoltage},
    {"ewe", ColumnKind::kVoltage},  // working electrode
    {"vf", ColumnKind::kVoltage},   // "full", the measured voltage of potentiostats
    {"vm", ColumnKind::kVoltage},
    {"i", ColumnKind::kCurrent},
    {"im", ColumnKind::kCurrent},
    {"current", ColumnKind::kCurrent},
    {"currents", ColumnKind::kCurrent},
    {"amperage", ColumnKind::kCurrent},  // "intensité", which may also be one of light
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
    {"direction", ColumnKind::kSweep},
    {"scandirection", ColumnKind::kSweep},
    {"sweepdirection", ColumnKind::kSweep},
    {"curve", ColumnKind::kCurve},
    {"irradiance", ColumnKind::kIrradiance},
    {"irr", ColumnKind::kIrradiance},
    {"irrad", ColumnKind::kIrradiance},
    {"effectiveirradiance", ColumnKind::kIrradiance},
    {"illuminance", ColumnKind::kIrradiance},
    {"intensity", ColumnKind::kIrradiance},
    {"g", ColumnKind::kIrradiance},
    {"poa", ColumnKind::kIrradiance},
    {"poairradiance", ColumnKind::kIrradiance},
    {"irradiancepoa", ColumnKind::kIrradiance},
    {"temperature", ColumnKind::kTemperature},
    {"temp", ColumnKind::kTemperature},
    {"tcell", ColumnKind::kTemperature},
    {"tc", ColumnKind::kTemperature},
    {"tmodule", ColumnKind::kTemperature},
    {"modt", ColumnKind::kTemperature},
    {"j", ColumnKind::kCurrentDensity},
    {"currentdensity", ColumnKind::kCurrentDensity},
};

// Words that say where a quantity was measured, not which one. A single letter may carry them:
// "Vmeas", "Idc".
constexpr std::string_view kQualifiers[] = {
    "pv",  "module",    "cell",  "panel",    "array", "string",   "load",   "bias",
    "dut", "device",    "anode", "measured", "meas",  "dc",       "output", "in",
    "opc", "electrode", "we",    "smu",      "corr",  "corrected"};

// Words that a number makes one of several: "Ch2 voltage", "PV1 current".
constexpr std::string_view kChannels[] = {"ch",     "channel", "px",   "pixel", "pv",
                                          "string", "str",     "mppt", "input"};

bool IsDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

const ColumnName* FindName(std::string_view text) {
  for (const ColumnName& name : kNames) {
    if (name.text == text) return &name;
  }
  return nullptr;
}

void DropQualifiers(std::vector<LabelWord>* words) {
  if (words->size() < 2) return;
  std::vector<LabelWord> kept;
  for (const LabelWord& word : *words) {
    if (!IsAmong(kQualifiers, word.text)) kept.push_back(word);
  }
  if (!kept.empty()) *words = kept;
}

void CutQualifierOffLetter(LabelWord* word) {
  if (word->text.size() < 3 || FindName(word->text) != nullptr) return;
  const ColumnName* letter = FindName(word->text.substr(0, 1));
  if (letter == nullptr || !IsElectrical(letter->kind)) return;
  if (IsAmong(kQualifiers, std::string_view(word->text).substr(1))) word->text.resize(1);
}

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
    LabelWord cut = {word.text.substr(0, letters), "", false};
    CutQualifierOffLetter(&cut);  // "vpv1" is a "v" with a number
    const std::string front = cut.text;
    const bool channel = IsAmong(kChannels, front);
    const ColumnName* name = FindName(front);
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

namespace {

// Directions, lights and averages, as labels name them. "up" and "down" also stand alone.
constexpr std::pair<std::string_view, SweepDirection> kDirections[] = {
    {"forward", SweepDirection::kForward},  {"fwd", SweepDirection::kForward},
    {"for", SweepDirection::kForward},      {"fw", SweepDirection::kForward},
    {"up", SweepDirection::kForward},       {"reverse", SweepDirection::kReverse},
    {"backward", SweepDirection::kReverse}, {"back", SweepDirection::kReverse},
    {"bwd", SweepDirection::kReverse},      {"rev", SweepDirection::kReverse},
    {"rv", SweepDirection::kReverse},       {"down", SweepDirection::kReverse}};
constexpr std::pair<std::string_view, SweepLight> kLights[] = {
    {"dark", SweepLight::kDark},          {"light", SweepLight::kLight},
    {"lit", SweepLight::kLight},          {"illuminated", SweepLight::kLight},
    {"illumination", SweepLight::kLight}, {"sunsvoc", SweepLight::kSunsVoc},
    {"pseudo", SweepLight::kSunsVoc}};
constexpr std::string_view kLamps[] = {"light", "lamp", "illumination", "led", "sun", "laser"};
constexpr std::string_view kAverages[] = {"average", "averaged", "avg", "mean"};

template <class T, std::size_t N>
const T* FindWord(const std::pair<std::string_view, T> (&list)[N], std::string_view text) {
  for (const auto& [word, value] : list) {
    if (word == text) return &value;
  }
  return nullptr;
}

// Records one word of a tag; false if it is none. "forD" is a direction with the letter of a light.
bool TakeTagWord(const LabelWord& word, ColumnTag* tag) {
  if (const auto* direction = FindWord(kDirections, word.text)) {
    tag->direction = *direction;
    return true;
  }
  if (const auto* light = FindWord(kLights, word.text)) {
    tag->light = *light;
    return true;
  }
  if (IsAmong(kAverages, word.text)) return tag->average = true;
  const std::string_view original = word.original;
  if (original.size() < 3 || (original.back() != 'D' && original.back() != 'L')) return false;
  const auto* direction = FindWord(kDirections, word.text.substr(0, word.text.size() - 1));
  if (direction == nullptr) return false;
  tag->direction = *direction;
  tag->light = original.back() == 'D' ? SweepLight::kDark : SweepLight::kLight;
  return true;
}

}  // namespace

ColumnTag TakeTag(std::vector<LabelWord>* words) {
  ColumnTag tag;
  std::vector<LabelWord> kept;
  for (std::size_t i = 0; i < words->size(); ++i) {
    LabelWord word = (*words)[i];
    const std::string_view next = i + 1 < words->size() ? (*words)[i + 1].text : std::string_view();
    const bool suns_voc = word.text == "suns" && !word.marked_as_unit && next == "voc";
    const bool switched = IsAmong(kLamps, word.text) && (next == "on" || next == "off");
    if (suns_voc) word = {"sunsvoc", "SunsVoc", false};
    if (switched) word = {next == "on" ? "lit" : "dark", word.original, false};
    if (suns_voc || switched) ++i;
    if (TakeTagWord(word, &tag)) continue;
    const ColumnName* letter = FindName(std::string_view(word.text).substr(0, 1));
    const bool electrical = letter != nullptr && IsElectrical(letter->kind);
    if (electrical && word.text.size() > 3 && FindName(word.text) == nullptr &&
        TakeTagWord({word.text.substr(1), word.original.substr(1), false}, &tag)) {
      word.text.resize(1);
      word.original.resize(1);
    }
    kept.push_back(word);
  }
  *words = kept;
  return tag;
}

ColumnTag ReadTag(std::string_view text) {
  std::vector<LabelWord> words = SplitLabel(text);
  ColumnTag tag = TakeTag(&words);
  for (const LabelWord& word : words) {
    if (word.text == "txt" || word.text == "csv" || word.text == "dat") continue;
    tag.device += (tag.device.empty() ? "" : " ") + word.original;
  }
  return tag;
}

namespace {

bool IsLetter(char c) { return c >= 'a' && c <= 'z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A number from `at` on, with a point or a comma, and where it ends.
struct NumberAt {
  double value = 0;
  std::size_t end = 0;
};

std::optional<NumberAt> ReadNumberAt(std::string_view text, std::size_t at) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.,", at), text.size());
  const auto number = ParseNumber(text.substr(at, end - at), true);
  if (!number) return std::nullopt;
  return NumberAt{*number, end};
}

std::optional<double> AsScale(double number) {
  for (const double scale : {0.1, 0.01, 0.001}) {
    if (number == scale || number * scale == 1) return scale;
  }
  return std::nullopt;
}

ScaledLabel Without(std::string_view label, std::size_t begin, std::size_t end, double scale) {
  return {std::string(label.substr(0, begin)) + std::string(label.substr(end)), scale};
}

// "gain 10", "scale: 0.1", "factor=0.01". A gain is what the register multiplies by.
std::optional<ScaledLabel> ByWord(std::string_view label, std::string_view lower) {
  for (const std::string_view word : {"gain", "scale", "factor", "multiplier", "resolution"}) {
    const std::size_t at = lower.find(word);
    if (at == std::string_view::npos || (at > 0 && IsLetter(lower[at - 1]))) continue;
    const std::size_t digit = lower.find_first_not_of(" =:_", at + word.size());
    if (digit == std::string_view::npos || !IsDigit(lower[digit])) continue;
    const auto number = ReadNumberAt(lower, digit);
    const auto scale = number ? AsScale(number->value) : std::nullopt;
    const bool fits = scale && (word == "gain" || number->value < 1);
    if (fits) return Without(label, at, number->end, *scale);
  }
  return std::nullopt;
}

// "0.1V", "x0.01 A": a power of ten right before a volt or an ampere.
std::optional<ScaledLabel> BeforeUnit(std::string_view label, std::string_view lower) {
  for (std::size_t at = lower.find('0'); at != std::string_view::npos;
       at = lower.find('0', at + 1)) {
    std::size_t begin = at;
    if (begin > 0 && (lower[begin - 1] == 'x' || lower[begin - 1] == '*')) --begin;
    const char before = begin == 0 ? ' ' : lower[begin - 1];
    if (IsLetter(before) || IsDigit(before) || before == '.' || before == ',') continue;
    const auto number = ReadNumberAt(lower, at);
    if (!number || !(number->value < 1)) continue;
    const auto scale = AsScale(number->value);
    const std::size_t unit = lower.find_first_not_of(' ', number->end);
    if (!scale || unit == std::string_view::npos) continue;
    const bool known = lower[unit] == 'v' || lower[unit] == 'a';
    const char after = unit + 1 < lower.size() ? lower[unit + 1] : ' ';
    if (!known || IsLetter(after) || IsDigit(after) || after == '/') continue;
    return Without(label, begin, unit, *scale);
  }
  return std::nullopt;
}

}  // namespace

ScaledLabel TakeScale(std::string_view label) {
  constexpr std::size_t kLongest = 300;
  if (label.size() > kLongest || label.find_first_of("01") == std::string_view::npos) {
    return {std::string(label)};
  }
  const std::string lower = LowerCase(label);
  if (const auto scaled = ByWord(label, lower)) return *scaled;
  if (const auto scaled = BeforeUnit(label, lower)) return *scaled;
  return {std::string(label)};
}

}  // namespace lyrefit
