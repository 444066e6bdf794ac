#include "lyrefit/read/letter_names.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_columns.h"

namespace lyrefit {
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
