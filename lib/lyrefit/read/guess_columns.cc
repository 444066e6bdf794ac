#include "lyrefit/read/guess_columns.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_columns.h"

namespace lyrefit {
namespace {

// Suffixes of V and I for key points and for quantities that were not measured.
constexpr std::string_view kNoReading[] = {
    "sc",  "oc",       "mp",    "mpp",   "pm",   "max",    "min", "x",   "xx",    "pmax",
    "set", "setpoint", "model", "fit",   "stc",  "ref",    "nom", "lim", "limit", "range",
    "src", "source",   "step",  "start", "stop", "offset", "ph",  "d",   "rms",   "nominal"};

// Interpretations of a column by its unit and by the first letter of its name.
struct Guess {
  ColumnKind by_unit = ColumnKind::kUnrecognised;
  ColumnKind by_letter = ColumnKind::kUnrecognised;
  std::string suffix;  // the name after the letter
  const Unit* unit = nullptr;
};

Guess GuessAt(std::string_view label) {
  Guess guess;
  const std::vector<LabelWord> words = SplitLabel(label);
  std::size_t name_words = 0;
  while (name_words < words.size() && !words[name_words].marked_as_unit) ++name_words;
  const std::string name = JoinWords(words, 0, name_words);
  const std::string unit = JoinWords(words, name_words, words.size());
  if (name.empty()) return guess;
  guess.suffix = name.substr(1);
  const bool no_reading =
      std::find(std::begin(kNoReading), std::end(kNoReading), guess.suffix) != std::end(kNoReading);
  if (no_reading) return guess;
  for (const ColumnKind kind :
       {ColumnKind::kVoltage, ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
    const Unit* found = FindUnit(kind, unit);
    if (found == nullptr) continue;
    guess.by_unit = kind;
    guess.unit = found;
  }
  const char letter = name[0];
  ColumnKind by_letter = ColumnKind::kUnrecognised;
  if (letter == 'v' || letter == 'u') by_letter = ColumnKind::kVoltage;
  if (letter == 'i') by_letter = ColumnKind::kCurrent;
  if (letter == 'j') by_letter = ColumnKind::kCurrentDensity;
  const bool fits = unit.empty() || guess.by_unit == by_letter ||
                    (IsCurrent(guess.by_unit) && IsCurrent(by_letter));
  if (!guess.suffix.empty() && fits) guess.by_letter = by_letter;
  return guess;
}

// Sets the two columns as voltage and current; other columns of these kinds are no longer used.
void TakePair(const std::vector<Guess>& guesses, int voltage, int current,
              std::vector<Column>* columns) {
  for (Column& column : *columns) {
    if (IsElectrical(column.kind)) column.kind = ColumnKind::kUnrecognised;
  }
  Become(ColumnKind::kVoltage, guesses[voltage].unit, &(*columns)[voltage]);
  const Guess& guess = guesses[current];
  const ColumnKind kind =
      guess.by_unit != ColumnKind::kUnrecognised ? guess.by_unit : guess.by_letter;
  Become(kind, guess.unit, &(*columns)[current]);
}

bool GuessByLetter(const std::vector<Guess>& guesses, std::vector<Column>* columns) {
  std::map<std::string, std::pair<std::vector<int>, std::vector<int>>> pairs;
  for (int i = 0; i < static_cast<int>(guesses.size()); ++i) {
    if (guesses[i].by_letter == ColumnKind::kVoltage) pairs[guesses[i].suffix].first.push_back(i);
    if (IsCurrent(guesses[i].by_letter)) pairs[guesses[i].suffix].second.push_back(i);
  }
  std::vector<std::pair<int, int>> found;
  for (const auto& [suffix, sides] : pairs) {
    const auto& [voltages, currents] = sides;
    if (voltages.size() == 1 && currents.size() == 1) found.emplace_back(voltages[0], currents[0]);
  }
  if (found.size() != 1) return false;
  TakePair(guesses, found[0].first, found[0].second, columns);
  return true;
}

bool GuessByUnit(const std::vector<Guess>& guesses, std::vector<Column>* columns) {
  const auto only = [&](ColumnKind kind) {
    int place = -1;
    for (int i = 0; i < static_cast<int>(guesses.size()); ++i) {
      const bool known = (*columns)[i].kind == kind && (*columns)[i].refusal.empty();
      if (!known && guesses[i].by_unit != kind) continue;
      if (place != -1) return -1;
      place = i;
    }
    return place;
  };
  const int voltage = only(ColumnKind::kVoltage);
  int current = only(ColumnKind::kCurrent);
  if (current == -1) current = only(ColumnKind::kCurrentDensity);
  if (voltage == -1 || current == -1) return false;
  const Column kept[] = {(*columns)[voltage], (*columns)[current]};
  TakePair(guesses, voltage, current, columns);
  if (kept[0].kind == ColumnKind::kVoltage) (*columns)[voltage] = kept[0];
  if (IsCurrent(kept[1].kind)) (*columns)[current] = kept[1];
  return true;
}

// Pairs of "a_rev_V" and "a_rev": the voltage has the name of its current. All columns must be such
// pairs.
bool GuessByVoltageName(std::vector<Column>* columns) {
  constexpr std::string_view kEnding = "_v";
  std::vector<ColumnPair> pairs;
  for (int i = 0; i < static_cast<int>(columns->size()); ++i) {
    const std::string name = LowerCase(TrimBlanks((*columns)[i].label));
    if (name.size() <= kEnding.size() || name.substr(name.size() - kEnding.size()) != kEnding) {
      continue;
    }
    const std::string current = name.substr(0, name.size() - kEnding.size());
    for (int k = 0; k < static_cast<int>(columns->size()); ++k) {
      if (LowerCase(TrimBlanks((*columns)[k].label)) == current) pairs.push_back({i, k});
    }
  }
  if (pairs.empty() || 2 * pairs.size() != columns->size()) return false;
  for (const ColumnPair& pair : pairs) {
    const ColumnTag tag = ReadTag((*columns)[pair.current].label);
    Become(ColumnKind::kVoltage, FindUnit(ColumnKind::kVoltage, "v"), &(*columns)[pair.voltage]);
    Become(ColumnKind::kCurrent, nullptr, &(*columns)[pair.current]);
    (*columns)[pair.voltage].tag = (*columns)[pair.current].tag = tag;
  }
  return true;
}

// Whether a name is a word with a number: "series1", "Pixel 3".
bool IsNumberedName(const std::string& name) {
  const std::size_t letters = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz");
  const std::size_t digits = name.find_first_of("0123456789");
  return letters != std::string::npos && letters > 3 && digits != std::string::npos &&
         digits <= letters + 1 && name.find_first_not_of("0123456789", digits) == std::string::npos;
}

// Open-circuit voltages over light. The light takes the place of the current.
bool GuessSunsVoc(std::vector<Column>* columns) {
  std::vector<std::string> labels;
  for (const Column& column : *columns) labels.push_back(column.label);
  const auto trace = FindSunsVoc(labels);
  if (!trace) return false;
  Become(ColumnKind::kVoltage, FindUnit(ColumnKind::kVoltage, "v"), &(*columns)[trace->voltage]);
  (*columns)[trace->voltage].factor = trace->voltage_factor;
  Become(ColumnKind::kCurrent, FindUnit(ColumnKind::kCurrent, "a"), &(*columns)[trace->light]);
  (*columns)[trace->light].light = true;
  return true;
}

// One voltage beside columns under the names of devices. They are currents if they share a unit of
// current, or if there is only one of them and its name is a word with a number.
bool GuessBesideVoltage(const std::vector<Guess>& guesses, std::vector<Column>* columns) {
  int voltage = -1;
  std::vector<int> others;
  for (int i = 0; i < static_cast<int>(columns->size()); ++i) {
    const Column& column = (*columns)[i];
    const bool known = column.kind == ColumnKind::kVoltage && column.refusal.empty();
    if (known || guesses[i].by_unit == ColumnKind::kVoltage) {
      if (voltage != -1) return false;
      voltage = i;
    } else if (column.kind == ColumnKind::kUnrecognised) {
      others.push_back(i);
    } else {
      return false;
    }
  }
  if (voltage == -1 || others.empty()) return false;
  const Guess& first = guesses[others[0]];
  const std::string name = LowerCase(TrimBlanks((*columns)[others[0]].label));
  const bool one_name = others.size() == 1 && columns->size() == 2 && IsNumberedName(name);
  const bool share_unit = IsCurrent(first.by_unit) &&
                          std::all_of(others.begin(), others.end(),
                                      [&](int other) { return guesses[other].unit == first.unit; });
  if (!one_name && !share_unit) return false;
  if ((*columns)[voltage].kind != ColumnKind::kVoltage) {
    Become(ColumnKind::kVoltage, guesses[voltage].unit, &(*columns)[voltage]);
  }
  for (const int other : others) {
    const std::string& label = (*columns)[other].label;
    const ColumnTag tag = ReadTag(std::string_view(label).substr(0, label.find_first_of("[(")));
    Become(share_unit ? first.by_unit : ColumnKind::kCurrent, first.unit, &(*columns)[other]);
    (*columns)[other].tag = tag;
  }
  return true;
}

}  // namespace

bool GuessColumns(std::vector<Column>* columns) {
  std::vector<Guess> guesses;
  for (const Column& column : *columns) guesses.push_back(GuessAt(column.label));
  return TakeDarkLitLetters(columns) || GuessByLetter(guesses, columns) ||
         GuessByVoltageName(columns) || TakeNamedPairs(columns) || GuessByUnit(guesses, columns) ||
         GuessSunsVoc(columns) || GuessBesideVoltage(guesses, columns);
}

namespace {

// A name such as "S4_V_D (V)".
struct LetterName {
  ColumnKind kind = ColumnKind::kUnrecognised;
  std::string device;  // what stands in front of the letter
  SweepLight light = SweepLight::kUnknown;
  const Unit* unit = nullptr;  // nullptr: none named
};
using LetterNames = std::vector<std::optional<LetterName>>;  // of each column

// What stands in front of the V and I of quantities that are no readings.
constexpr std::string_view kNoDevice[] = {"d",     "delta", "n",   "min", "max",   "mpp",  "mp",
                                          "oc",    "sc",    "set", "src", "std",   "sd",   "err",
                                          "sigma", "lim",   "ref", "nom", "start", "stop", "step"};

ColumnKind KindOfLetter(std::string_view letter) {
  if (letter == "v" || letter == "u") return ColumnKind::kVoltage;
  if (letter == "i") return ColumnKind::kCurrent;
  return letter == "j" ? ColumnKind::kCurrentDensity : ColumnKind::kUnrecognised;
}

SweepLight LightOfLetter(std::string_view letter) {
  if (letter == "d") return SweepLight::kDark;
  return letter == "l" ? SweepLight::kLight : SweepLight::kUnknown;
}

// Takes the unit of a name from its words from `from` on. False if they are no unit of its quantity.
bool TakeUnit(const std::vector<LabelWord>& words, std::size_t from, LetterName* name) {
  const std::string text = JoinWords(words, from, words.size());
  if (!text.empty() && text.find_first_not_of("0123456789") == std::string::npos) {
    name->device += " " + text;  // "AV(1)": the first of several runs
    return true;
  }
  for (const ColumnKind kind : {name->kind, ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
    if (text.empty() || (kind != name->kind && !IsCurrent(name->kind))) continue;
    name->unit = FindUnit(kind, text);
    if (name->unit == nullptr) continue;
    name->kind = kind;
    return true;
  }
  return text.empty();
}

// Takes a light in front of the quantity: "D_V", "LI". The d of "dV" is no light.
void TakeLightInFront(LetterName* name) {
  std::string& device = name->device;
  const std::size_t size = device.size();
  const bool last_word = size == 1 || (size > 1 && device[size - 2] == ' ');
  if (name->light != SweepLight::kUnknown || !last_word) return;
  if (device.back() != 'D' && device.back() != 'L') return;
  name->light = device.back() == 'D' ? SweepLight::kDark : SweepLight::kLight;
  device = TrimBlanks(std::string_view(device).substr(0, size - 1));
}

std::optional<LetterName> ReadName(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  std::size_t count = 0;
  while (count < words.size() && !words[count].marked_as_unit) ++count;
  if (count == 0) return std::nullopt;
  LetterName name;
  std::size_t end = count - 1;  // of the words of the device
  std::string in_front;         // of a letter at the end of a word
  const std::string_view last = words[end].text;
  const auto is_quantity = [](std::string_view letter) {
    return KindOfLetter(letter) != ColumnKind::kUnrecognised;
  };
  std::string_view letter = last.substr(last.size() - 1);
  if (end > 0 && is_quantity(words[end - 1].text) && LightOfLetter(last) != SweepLight::kUnknown) {
    name.light = LightOfLetter(last);
    letter = words[--end].text;
  } else if (last.size() == 2 && is_quantity(last.substr(0, 1)) &&
             LightOfLetter(letter) != SweepLight::kUnknown) {
    name.light = LightOfLetter(letter);
    letter = last.substr(0, 1);
  } else {
    const bool as_written = words[end].original.size() == last.size();  // not translated
    in_front = (as_written ? words[end].original : words[end].text).substr(0, last.size() - 1);
  }
  name.kind = KindOfLetter(letter);
  for (std::size_t i = 0; i < end; ++i) name.device += words[i].original + " ";
  name.device = TrimBlanks(name.device + in_front);
  TakeLightInFront(&name);
  if (!is_quantity(letter) || !TakeUnit(words, count, &name)) return std::nullopt;
  return name;
}

LetterNames ReadNames(const std::vector<Column>& columns) {
  LetterNames names;
  for (const Column& column : columns) names.push_back(ReadName(column.label));
  return names;
}

// Whether currents of one device are there in the dark and at light.
bool HoldsDarkAndLit(const LetterNames& names) {
  return std::any_of(names.begin(), names.end(), [&](const auto& dark) {
    return dark && IsCurrent(dark->kind) && dark->light == SweepLight::kDark &&
           std::any_of(names.begin(), names.end(), [&](const auto& lit) {
             return lit && IsCurrent(lit->kind) && lit->light == SweepLight::kLight &&
                    lit->device == dark->device;
           });
  });
}

// The tag of a device. A word F or R of it is a direction if another name has the other in its place.
ColumnTag TagOf(const std::string& device, const LetterNames& names) {
  for (const auto& [own, other, direction] : {std::tuple(" F ", " R ", SweepDirection::kForward),
                                              {" R ", " F ", SweepDirection::kReverse}}) {
    std::string turned = " " + device + " ";
    const std::size_t at = turned.find(own);
    if (at == std::string::npos) continue;
    turned.replace(at, 3, other);
    const bool both = std::any_of(names.begin(), names.end(), [&](const auto& name) {
      return name && name->light != SweepLight::kUnknown && " " + name->device + " " == turned;
    });
    if (!both) continue;
    ColumnTag tag;
    tag.direction = direction;
    tag.device = TrimBlanks(turned.replace(at, 3, " "));
    return tag;
  }
  return ReadTag(device);
}

}  // namespace

bool TakeDarkLitLetters(std::vector<Column>* columns) {
  const LetterNames names = ReadNames(*columns);
  if (!HoldsDarkAndLit(names)) return false;
  const bool own_voltages = std::any_of(names.begin(), names.end(), [](const auto& name) {
    return name && name->kind == ColumnKind::kVoltage && name->light != SweepLight::kUnknown;
  });
  std::vector<Column> taken = *columns;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const std::optional<LetterName>& name = names[i];
    if (name && name->light != SweepLight::kUnknown) {
      Become(name->kind, name->unit, &taken[i]);
      taken[i].tag = TagOf(name->device, names);
      taken[i].tag.light = name->light;
      taken[i].tag.by_letter = true;
    } else if (IsCurrent(taken[i].kind) || (own_voltages && IsElectrical(taken[i].kind))) {
      taken[i].kind = ColumnKind::kUnrecognised;
    }
  }
  if (FindChannels(taken).empty()) return false;
  *columns = std::move(taken);
  return true;
}

bool TakeNamedPairs(std::vector<Column>* columns) {
  LetterNames names = ReadNames(*columns);
  std::map<std::string, std::pair<int, int>> counts;  // of voltages and currents by device
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (IsElectrical((*columns)[i].kind)) return false;
    if (!names[i]) continue;
    const std::string device = LowerCase(names[i]->device);
    const bool none =
        device.empty() || names[i]->light != SweepLight::kUnknown ||
        std::find(std::begin(kNoDevice), std::end(kNoDevice), device) != std::end(kNoDevice);
    if (none) {
      names[i].reset();
    } else {
      ++(IsCurrent(names[i]->kind) ? counts[device].second : counts[device].first);
    }
  }
  const auto is_pair = [](const auto& one) { return one.second == std::pair(1, 1); };
  const auto pairs = std::count_if(counts.begin(), counts.end(), is_pair);
  if (pairs == 0) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i] || counts[LowerCase(names[i]->device)] != std::pair(1, 1)) continue;
    Become(names[i]->kind, names[i]->unit, &(*columns)[i]);
    if (pairs > 1) (*columns)[i].tag.device = names[i]->device;
  }
  return true;
}

}  // namespace lyrefit
